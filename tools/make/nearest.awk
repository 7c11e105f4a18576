# Prints the line of standard input that is most like -v word=..., whatever the case of its letters; nothing when none is like it.
function distance(a, b,    i, j, cost, row, before, above) {
  for (j = 0; j <= length(b); ++j) row[j] = j
  for (i = 1; i <= length(a); ++i) {
    before = row[0]
    row[0] = i
    for (j = 1; j <= length(b); ++j) {
      above = row[j]
      cost = before + (substr(a, i, 1) != substr(b, j, 1))
      if (row[j] + 1 < cost) cost = row[j] + 1
      if (row[j - 1] + 1 < cost) cost = row[j - 1] + 1
      row[j] = cost
      before = above
    }
  }
  return row[length(b)]
}
{
  d = distance(toupper(word), toupper($0))
  if (best == "" || d < least) { least = d; best = $0 }
}
END { if (3 * least <= length(word) + 2) print best }
