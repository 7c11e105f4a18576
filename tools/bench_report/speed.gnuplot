# The picture of bench_report.py, which fills in the words between @ signs.
set terminal svg size 1150,420 font 'sans-serif,14' background 'white'
set output '@OUTPUT@'
set border 3
set tics nomirror out
set grid ytics linecolor '#dddddd'
set yrange [0:*]
set bmargin 4.5
set pointsize 1.2
set ylabel 'core cycles per particle-step'
set multiplot layout 1,2

set offsets 0, 0, graph 2.0, 0  # room for the key
set title 'whole steps'
set logscale x
set xrange [100:2000000]
set format x '10^{%T}'
set xlabel 'particles'
set key top right
plot @CURVES@

if (@HAS_STAGES@) {
  unset offsets
  unset logscale x
  set xrange [*:*]
  set format x
  unset xlabel
  set title 'stages of a step, bed of 1000'
  set style data histograms
  set style histogram rowstacked
  set style fill solid 0.85 border rgb 'white'
  set boxwidth 0.7
  set key outside right top reverse Left invert
  plot for [k = 2:7] '@STAGES@' using k:xticlabels(1) title columnheader(k)
}
unset multiplot
