#include "tangent.hpp"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fixdem::stability {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Maximum eigenvalue of a symmetric matrix without negative ones; `vector` is the start, and the eigenvector after.
/// The start must hold some of that eigenvector, or another one is found.
double maximum(const Matrix& matrix, Vector& vector) {
  constexpr int most_iterations = 3000;
  double value = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Vector image = matrix * vector;
    value = vector.dot(image);
    const double residual = (image - value * vector).norm();
    if (!(value > 0) || !std::isfinite(value)) throw std::runtime_error("the stiffness is zero or no number");
    vector = image / image.norm();
    if (residual < 1e-6 * value) break;
  }
  return value;
}

/// A start that no eigenvector is orthogonal to, but by chance: the same on every machine.
Vector start_vector(Eigen::Index size) {
  Vector vector(size);
  double seed = 0.5;
  for (Eigen::Index k = 0; k < size; ++k) {
    seed = seed * 997 - std::floor(seed * 997) + 1e-3;
    vector[k] = seed - 0.5;
  }
  return vector / vector.norm();
}

/// Collects rows of one spring: its elongation as a linear form of the coordinates of two particles.
class Assembler {
 public:
  explicit Assembler(std::size_t springs) { entries_.reserve(springs * 300); }
  /// Adds value * form form^T.
  void add(double value, const std::vector<std::pair<int, double>>& form) {
    for (const auto& [row, a] : form)
      for (const auto& [column, b] : form) entries_.emplace_back(row, column, value * a * b);
  }
  Matrix matrix(int size) const {
    Matrix m(size, size);
    m.setFromTriplets(entries_.begin(), entries_.end());
    return m;
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
};

struct Tangent {
  Matrix stiffness, normal_damping, tangential_damping;
};

Tangent tangent(const SpringNetwork& network, Springs kind) {
  const double mass = network.mass;
  const std::vector<Spring>& springs = network.springs;
  Assembler stiffness(springs.size()), normal_damping(springs.size()), tangential_damping(springs.size());
  const double turning = std::sqrt(2.5);  // r / sqrt(I / m)
  for (const Spring& s : springs) {
    const double* n = s.normal;
    const int from = 6 * s.owner, to = 6 * s.partner;
    // Coordinates carry the root of the own mass.
    const double own = 1 / std::sqrt(network.mass_share(s.owner));
    const double other = s.partner >= 0 ? 1 / std::sqrt(network.mass_share(s.partner)) : 0;
    std::vector<std::pair<int, double>> along;
    for (int c = 0; c < 3; ++c) {
      along.emplace_back(from + c, own * n[c]);
      if (s.partner >= 0) along.emplace_back(to + c, -other * n[c]);
    }
    stiffness.add(s.at.stiffness / mass, along);
    normal_damping.add(s.at.damping / mass, along);
    if (kind == Springs::normal) continue;
    // Two tangents: any vector off the normal, and the cross product with it.
    const Eigen::Vector3d normal(n[0], n[1], n[2]);
    const Eigen::Vector3d first = normal.unitOrthogonal(), tangents[2] = {first, normal.cross(first)};
    for (const Eigen::Vector3d& t : tangents) {
      const Eigen::Vector3d turn = turning * normal.cross(t);  // t . (theta x n) = theta . (n x t)
      const double own_lever = own * network.rolling_lever(s.owner, s.partner);
      const double other_lever = s.partner >= 0 ? other * network.rolling_lever(s.partner, s.owner) : 0;
      std::vector<std::pair<int, double>> slip, rolling;
      for (int c = 0; c < 3; ++c) {
        slip.emplace_back(from + c, own * t[c]);
        slip.emplace_back(from + 3 + c, own * turn[c]);
        rolling.emplace_back(from + 3 + c, own_lever * turn[c]);
        if (s.partner < 0) continue;
        slip.emplace_back(to + c, -other * t[c]);
        slip.emplace_back(to + 3 + c, other * turn[c]);
        rolling.emplace_back(to + 3 + c, -other_lever * turn[c]);
      }
      stiffness.add(s.at.tangential_stiffness / mass, slip);
      tangential_damping.add(s.at.tangential_damping / mass, slip);
      if (s.at.rolling_stiffness == 0) continue;
      stiffness.add(s.at.rolling_stiffness / mass, rolling);
      tangential_damping.add(s.at.rolling_damping / mass, rolling);
    }
  }
  const int size = 6 * network.particle_count;
  return {stiffness.matrix(size), normal_damping.matrix(size), tangential_damping.matrix(size)};
}

}  // namespace

double SpringNetwork::rolling_lever(int particle, int partner) const {
  if (partner < 0) return 1;
  if (sizes.empty()) return 0.5;
  const double own = sizes[static_cast<std::size_t>(particle)].radius;
  const double other = sizes[static_cast<std::size_t>(partner)].radius;
  return other / (own + other);
}

SpringNetwork network_of(const program::CaseFacts& facts, const std::vector<Contact>& contacts) {
  SpringNetwork network{facts.particle_count, facts.mass, {}};
  for (const Contact& c : contacts)
    network.springs.push_back(
        {c.owner,
         c.partner,
         {c.normal[0], c.normal[1], c.normal[2]},
         program::tangent_spring(facts.normal, program::contact_coefficients(facts, c.owner, c.partner), c.overlap)});
  if (facts.has_sizes())
    for (int id = 0; id < facts.particle_count; ++id)
      network.sizes.push_back({facts.mass_of(id) / facts.mass, facts.radius_of(id)});
  return network;
}

SpringNetwork alone(const SpringNetwork& network, const Spring& spring) {
  Spring moved = spring;
  moved.owner = 0, moved.partner = spring.partner >= 0 ? 1 : spring.partner;
  SpringNetwork pair{2, network.mass, {moved}};
  if (!network.sizes.empty())
    for (const int id : {spring.owner, spring.partner >= 0 ? spring.partner : spring.owner})
      pair.sizes.push_back(network.sizes[static_cast<std::size_t>(id)]);
  return pair;
}

double undamped_critical_step(const SpringNetwork& network, Springs kind) {
  const Tangent t = tangent(network, kind);
  if (t.stiffness.nonZeros() == 0) return std::numeric_limits<double>::infinity();
  Vector mode = start_vector(t.stiffness.rows());
  return 2 / std::sqrt(maximum(t.stiffness, mode));
}

double critical_step(const SpringNetwork& network, const program::StepCriterion& criterion) {
  const Tangent t = tangent(network, Springs::all);
  if (t.stiffness.nonZeros() == 0) return std::numeric_limits<double>::infinity();
  const Matrix damping =
      criterion.normal_damping * t.normal_damping + criterion.tangential_damping * t.tangential_damping;
  const Vector start = start_vector(t.stiffness.rows());
  Vector mode = start;
  double h = 2 / std::sqrt(maximum(t.stiffness, mode));
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Matrix matrix = h * h * t.stiffness + h * damping;
    mode = (mode + start).normalized();  // where damping counts, other particles may be the ones that limit the step
    maximum(matrix, mode);
    const double k = mode.dot(t.stiffness * mode), c = mode.dot(damping * mode);
    const double next = 8 / (c + std::sqrt(c * c + 16 * k));
    if (std::fabs(next - h) <= 1e-7 * h) return next;
    h = next;
  }
  throw std::runtime_error("the critical step did not converge");
}

}  // namespace fixdem::stability
