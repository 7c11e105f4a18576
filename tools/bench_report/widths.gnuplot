# The picture of bench_report.py against the width of the pipe; it fills in the words between @ signs.
set terminal svg size 700,420 font 'sans-serif,14' background 'white'
set output '@OUTPUT@'
set border 3
set tics nomirror out
set grid ytics linecolor '#dddddd'
set yrange [0:*]
set logscale x
set xrange [4:60]
set xtics (5, 10, 17, 30, 50)
set xlabel 'diameter of the pipe by that of a particle'
set ylabel 'million particle-steps/s'
set key outside right top
set pointsize 1.2
plot @CURVES@
