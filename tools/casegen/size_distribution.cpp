// Quantiles in closed form: of the (logarithmic) normal distribution by the inverse error function of Boost, of a
// sieve curve by inverting what lies between two sieves.
//
// Between two sieves, of meshes a and b, a curve by volume has a constant density of volume, so a density of number
// that goes with d^-3. Of a volume V there are then V (a + b)/(2 a^2 b^2) particles, but for a factor common to all,
// and the share (a^-2 - d^-2)/(a^-2 - b^-2) of them is smaller than d.
#include "size_distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "tools/run/random_numbers.hpp"

namespace fixdem::casegen {
namespace {

const boost::math::normal standard;

}  // namespace

double to_ten_digits(double value) { return std::strtod(fmt::format("{:.9e}", value).c_str(), nullptr); }

SizeDistribution::SizeDistribution(const CaseValues& v)
    : kind_(v.size_distribution == "uniform"     ? Kind::uniform
            : v.size_distribution == "normal"    ? Kind::normal
            : v.size_distribution == "lognormal" ? Kind::lognormal
                                                 : Kind::table),
      low_(v.size_minimum),
      high_(v.size_maximum),
      by_volume_(v.size_weight == "volume") {
  if (kind_ == Kind::normal || kind_ == Kind::lognormal) {
    const bool is_logarithmic = kind_ == Kind::lognormal;
    middle_ = is_logarithmic ? std::log(v.size_median) : v.size_mean;
    deviation_ = is_logarithmic ? v.size_spread : v.size_deviation;
    below_ = cdf(standard, (scaled(low_) - middle_) / deviation_);
    above_ = cdf(complement(standard, (scaled(high_) - middle_) / deviation_));
    kept_ = std::max(1 - below_ - above_, 0.0);
  } else if (kind_ == Kind::table) {
    diameters_ = v.size_diameters;
    low_ = diameters_.front();
    high_ = diameters_.back();
    for (std::size_t i = 0; i + 1 < diameters_.size(); ++i) {
      const double share = v.size_below[i + 1] - v.size_below[i], a = diameters_[i], b = diameters_[i + 1];
      numbers_.push_back(by_volume_ ? share * (a + b) / (2 * a * a * b * b) : share);
    }
  }
}

double SizeDistribution::scaled(double diameter) const {
  return kind_ == Kind::lognormal ? std::log(diameter) : diameter;
}

double SizeDistribution::normal_quantile(double share) const {
  const double below = below_ + share * kept_, above = above_ + (1 - share) * kept_;
  const double x =
      below < above ? boost::math::quantile(standard, below) : boost::math::quantile(complement(standard, above));
  const double value = middle_ + deviation_ * x;
  return kind_ == Kind::lognormal ? std::exp(value) : value;
}

double SizeDistribution::table_quantile(double share) const {
  std::size_t last = numbers_.size() - 1, i = 0;
  while (numbers_[last] == 0) --last;  // where rounding could lead to
  double rest = share * std::accumulate(numbers_.begin(), numbers_.end(), 0.0);
  while (i < last && rest > numbers_[i]) rest -= numbers_[i++];
  const double within = std::min(rest / numbers_[i], 1.0), a = diameters_[i], b = diameters_[i + 1];
  return by_volume_ ? a / std::sqrt(1 - within * (1 - (a / b) * (a / b))) : a + within * (b - a);
}

double SizeDistribution::quantile(double share) const {
  double diameter = 0;
  switch (kind_) {
    case Kind::uniform:
      diameter = low_ + share * (high_ - low_);
      break;
    case Kind::normal:
    case Kind::lognormal:
      diameter = normal_quantile(share);
      break;
    case Kind::table:
      diameter = table_quantile(share);
      break;
  }
  return std::clamp(to_ten_digits(diameter), low_, high_);
}

std::vector<double> distributed_diameters(const CaseValues& v, std::int64_t number) {
  const SizeDistribution distribution(v);
  const auto count = static_cast<std::size_t>(number);
  std::vector<double> diameters(count);
  for (std::size_t k = 0; k < count; ++k)
    diameters[k] = distribution.quantile((static_cast<double>(k) + 0.5) / static_cast<double>(count));
  program::RandomNumbers random(static_cast<unsigned long long>(v.size_seed));
  for (std::size_t last = count; last > 1; --last)  // std::shuffle is another one in each library
    std::swap(diameters[last - 1], diameters[static_cast<std::size_t>(random.unit() * static_cast<double>(last))]);
  return diameters;
}

}  // namespace fixdem::casegen
