# The plot of docs/widening.md: gnuplot docs/images/widening.gp, from the project's root. Figures as in its tables.
set terminal pngcairo size 1160,460 font "DejaVu Sans,10"
set output "docs/images/widening.png"
$error << end
0 0.0610 0.0962 0.1247 0.1763 0.2707 0.3438
1 0.0174 0.0269 0.0350 0.0290 0.0391 0.0559
2 0.0082 0.0127 0.0143 0.0166 0.0248 0.0278
3 0.0051 0.0088 0.0109 0.0069 0.0126 0.0166
4 0.0035 0.0065 0.0080 0.0058 0.0109 0.0137
5 0.0020 0.0040 0.0051 0.0032 0.0066 0.0099
6 0.0019 0.0039 0.0050 0.0029 0.0059 0.0084
7 0.0013 0.0025 0.0030 0.0021 0.0043 0.0059
8 0.0013 0.0027 0.0033 0.0020 0.0039 0.0052
end
# order, nanoseconds per evaluation with 8 lobes, median error at r = 0.25 and 0.5
$cost << end
0 6.2  0.0610 0.1763
1 38   0.0174 0.0290
2 86   0.0082 0.0166
3 105  0.0051 0.0069
4 177  0.0035 0.0058
5 245  0.0020 0.0032
8 542  0.0013 0.0020
end
set multiplot layout 1,2
set logscale y
set format y "%g"
set yrange [0.001:0.5]
set ylabel "relRMSE against the integral"
set grid ytics lc rgb "#dddddd"
set xlabel "order"
set xrange [-0.3:8.3]
set xtics ("closed form" 0, 1, 2, 3, 4, 5, 6, 7, 8)
set key top right
set title "Over 70 materials: median (line), 90th percentile, worst (bars)"
plot $error using ($1+0.06):5:5:7 with yerrorbars lc rgb "#c0504d" pt 7 ps 0.4 notitle, \
     $error using ($1+0.06):5 with lines lw 2 lc rgb "#c0504d" title "r = 0.5", \
     $error using ($1+0.06):6 with points pt 2 lc rgb "#c0504d" notitle, \
     $error using ($1-0.06):2:2:4 with yerrorbars lc rgb "#31859c" pt 7 ps 0.4 notitle, \
     $error using ($1-0.06):2 with lines lw 2 lc rgb "#31859c" title "r = 0.25", \
     $error using ($1-0.06):3 with points pt 2 lc rgb "#31859c" notitle
set logscale x
set xrange [4:1000]
set xtics (5, 10, 20, 50, 100, 200, 500, 1000)
set xlabel "ns per evaluation, 8 lobes, 2 cores"
set title "Median error against time"
plot $cost using 2:4:1 with labels offset 1,0.7 notitle, $cost using 2:4 with linespoints lw 2 pt 7 lc rgb "#c0504d" title "r = 0.5", \
     $cost using 2:3 with linespoints lw 2 pt 7 lc rgb "#31859c" title "r = 0.25"
unset multiplot
