# SPDX-License-Identifier: BSD-3-Clause
# Draws what a scope has saved (runner/scope.hpp), from any port:
#     gnuplot -e "file='scope.csv'" examples/scope.gp          writes scope.csv.svg
# Four panels over time: positions and depth; forces, wanted and given; the ledger; the length of the ticks.
# Where a tick had more to say than `nominal`, the last panel has a mark at the length of that tick.
if (!exists("file")) file = "scope.csv"
set datafile separator ","
set key autotitle columnhead

# Every port has columns of its own, so they are found by the beginning of their names. What was not told is
# empty in every row, and not drawn.
names = system("head -n 1 '".file."' | tr ',' ' '")
told(i) = system(sprintf("tail -n +2 '%s' | cut -d , -f %d | grep -c .", file, i)) > 0
places = ""
forces = ""
do for [i=1:words(names)] {
  c = word(names, i)
  if (!told(i)) { continue }
  if (c[1:8] eq "position" || c[1:5] eq "depth") { places = places." ".c }
  if (c[1:6] eq "wanted" || c[1:5] eq "given") { forces = forces." ".c }
}

set terminal svg size 1000,900 background rgb "white"
set output file.".svg"
set multiplot layout 4,1
set lmargin 12
set rmargin 24
set key outside right top noenhanced
set grid

set yrange [*<0:0<*]
set ylabel "position, depth"
plot for [c in places] file using (column("time_s")):(column(c)) with lines title c
set ylabel "force"
plot for [c in forces] file using (column("time_s")):(column(c)) with lines title c
set ylabel "ledger [mJ]"
plot file using (column("time_s")):(1e3*column("energy_J")) with lines title "energy_J"
set ylabel "tick [ms]"
set yrange [0:*]
set xlabel "time [s]"
plot file using (column("time_s")):(1e3*column("dt_s")) with lines title "dt_s", \
  file using (column("time_s")):(column("event") > 0 ? 1e3*column("dt_s") : 1/0) \
  with points pointtype 7 pointsize 0.6 title "an event"
unset multiplot
