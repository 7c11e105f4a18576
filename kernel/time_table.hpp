// Values that change in time: a table in a case's header, linear in between and constant outside.
#pragma once

namespace fixdem {

struct TimeValue {
  double time;   ///< s
  double value;  ///< what the case says
};

/// Value at a time. Times increase; a table has one row at least.
template <int Rows>
constexpr double value_at(const TimeValue (&table)[Rows], double time) {
  if (!(time > table[0].time)) return table[0].value;
  for (int k = 1; k < Rows; ++k) {
    const TimeValue &from = table[k - 1], &to = table[k];
    if (time < to.time) return from.value + (to.value - from.value) * ((time - from.time) / (to.time - from.time));
  }
  return table[Rows - 1].value;
}

/// Its integral from `begin` to `end`, exact but for rounding; zero where the end comes first.
template <int Rows>
constexpr double integral_of(const TimeValue (&table)[Rows], double begin, double end) {
  double sum = 0;
  const auto add = [&](double from, double to) {
    if (from < begin) from = begin;
    if (to > end) to = end;
    if (from < to) sum += 0.5 * (value_at(table, from) + value_at(table, to)) * (to - from);
  };
  add(begin, table[0].time);
  for (int k = 1; k < Rows; ++k) add(table[k - 1].time, table[k].time);
  add(table[Rows - 1].time, end);
  return sum;
}

}  // namespace fixdem
