// Charts by gnuplot, a program that runs as a child: a script goes in, an SVG comes out. Thread-safe.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slopemix::cli {

// Throws CommandError if there is no gnuplot to run: asked before long work.
void require_gnuplot();

// The SVG that a script draws. Throws CommandError with what gnuplot said.
std::string run_gnuplot(const std::string &script);

// Begins a script: SVG of this size in pixels, fonts, thin grid, UTF-8.
std::string chart_head(int width, int height);

// A text as gnuplot's quoted string, in which nothing is special; unprintable characters become spaces.
std::string chart_text(const std::string &text);

// A number in the shortest form; NaN, which gnuplot leaves out, where it is not finite.
std::string chart_number(double value);

// Names a block of data, "$name"; each row is a line.
std::string chart_data(const std::string &name, const std::vector<std::vector<double>> &rows);

// `count` colours from light to dark, "#rrggbb", told apart by lightness alone; one colour is dark.
std::vector<std::string> chart_shades(std::size_t count);

} // namespace slopemix::cli
