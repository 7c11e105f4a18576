// The pipe as letters: seen from the side (-x), z to the right, y up; the more solid matter behind a letter, the
// heavier it.
//
// Each particle is spread over the cells that its circle covers, by the depth of the sphere behind each sample, and a
// cell's letter follows from the solids fraction of what lies behind it: blank for nothing, '@' from 0.6 up. Cells also
// know the mean axial velocity of what is in them. Any number of columns and rows; a letter is taken for twice as high
// as wide. SI units.
#pragma once

#include <string>
#include <vector>

#include "case_facts.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

class SideView {
 public:
  /// Of the whole pipe, or of the part of `length` from `begin` on. As many rows as its proportions ask for, but 6
  /// to 20.
  SideView(const CaseFacts& facts, int columns) : SideView(facts, columns, 0, facts.pipe_length) {}
  SideView(const CaseFacts&, int columns, double begin, double length);

  void draw(const Snapshot&);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  char letter(int row, int column) const;
  double axial_velocity(int row, int column) const;  ///< m/s, 0 where nothing is

 private:
  struct Cell {
    double solids = 0, momentum = 0;  ///< m3, m4/s
  };
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  ParticleKinds kinds_;
  double pipe_radius_, begin_, length_;
  bool is_periodic_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace fixdem::program
