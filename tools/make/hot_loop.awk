# Reads the disassembly of a program (objdump -d -C --no-show-raw-insn) and prints its hot loops: in the functions of the
# pair contacts, the innermost loops (spans closed by a backward jump with no other such span inside) that take packed
# square roots. Two stages (geometry; law) of three forms (at rest; moving; sparse) make up to six of them.

/^[0-9a-f]+ <.*>:$/ { finish(); name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/>:$/, "", name); lines = 0; next }

/^ +[0-9a-f]+:/ && name ~ /pair_contacts|PairSide/ {
  address = $1
  sub(/:$/, "", address)
  at[address] = ++lines
  text[lines] = $0
  sub(/ <.*>$/, "", text[lines])
  operation[lines] = $2
  target[lines] = ($2 ~ /^j/) ? $3 : ""
}

END {
  finish()
  if (!printed) {
    print "no loop with packed square roots in the pair contacts" > "/dev/stderr"
    exit 1
  }
}

function finish(    i, j, first, last, loops, inner, roots, divisions, shown) {
  shown = 0  # last line printed: loops with a common body are shown once
  for (i = 1; i <= lines; ++i)
    if (target[i] != "" && (target[i] in at) && at[target[i]] <= i) { first[++loops] = at[target[i]]; last[loops] = i }
  for (i = 1; i <= loops; ++i) {
    inner = 1
    for (j = 1; j <= loops && inner; ++j)
      if (j != i && first[j] >= first[i] && last[j] <= last[i] && last[j] - first[j] < last[i] - first[i]) inner = 0
    if (!inner || first[i] <= shown) continue
    roots = divisions = 0
    for (j = first[i]; j <= last[i]; ++j) { roots += operation[j] ~ /sqrtp[ds]/; divisions += operation[j] ~ /divp[ds]/ }
    if (!roots) continue
    print name
    print last[i] - first[i] + 1 " instructions, of them " roots " packed square roots and " divisions " divisions"
    for (j = first[i]; j <= last[i]; ++j) print text[j]
    print ""
    shown = last[i]
    ++printed
  }
  delete at
}
