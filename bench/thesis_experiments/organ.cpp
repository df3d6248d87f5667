// SPDX-License-Identifier: BSD-3-Clause
#include "organ.hpp"

#include "../common/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace experiments {

namespace {

constexpr int samples = 2000;            ///< of the path
constexpr double stroked_share = 0.4;    ///< of the longest side
constexpr double least_body = 2 * 3e-3;  ///< below the surface [m]: twice what the stroke is deep

double smooth(double s) {
  const double x = std::clamp(s, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace

stroke_scene::stroke_scene(organ which)
    : organ_(std::move(which)),
      surface_(env::boundary(organ_.mesh)),
      box_(env::bounds(organ_.mesh)) {
  const vector3 size = box_.sizes();
  size.minCoeff(&up_);
  size.maxCoeff(&along_);
  vertex_normals_.assign(mesh().nodes.size(), vector3::Zero());
  for (const auto& t : surface_) {
    const auto [a, b, c] = env::corners(t, mesh().nodes);
    const vector3 area = volume::cross(b - a, c - a);
    for (const int node : t.nodes) vertex_normals_[static_cast<std::size_t>(node)] += area;
  }
  hold();
  find_path();
}

/// The first line, from the middle outwards, that can be stroked all the way, or else the one with the
/// longest piece.
void stroke_scene::find_path() {
  for (const double aside : {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4, -0.4}) {
    auto path = path_beside(aside);
    if (path.size() > path_.size()) path_ = std::move(path);
    if (path_.size() > samples) return;
  }
  if (path_.size() > samples / 2) return;
  const double share = stroked_share * static_cast<double>(path_.size()) / samples;
  throw unusable_organ(organ_,
                       "has no place for a stroke 3 mm deep along " + axis(along_) +
                           ": the longest piece of surface with 6 mm of body below it takes " +
                           format("%.2g", 100.0 * share) + " % of its length, not 20; " +
                           measured(organ_),
                       other_unit(organ_) + ", or one body that is thick enough");
}

/// The longest piece that can be stroked, over a line that is `aside` times the organ's size from its
/// middle.
std::vector<stroke_scene::point_on_surface> stroke_scene::path_beside(double aside) const {
  vector3 middle = (box_.min() + box_.max()) / 2.0;
  const Eigen::Index across = 3 - up_ - along_;
  if (aside != 0.0) middle(across) += aside * box_.sizes()(across);
  std::vector<point_on_surface> longest, piece;
  for (int i = 0; i <= samples; ++i) {
    vector3 foot = middle;
    foot(along_) += (static_cast<double>(i) / samples - 0.5) * stroked_share * box_.sizes()(along_);
    if (const auto top = top_over(foot)) {
      piece.push_back(*top);
    } else {
      piece.clear();
    }
    if (piece.size() > longest.size()) longest = piece;
  }
  return longest;
}

vector3 stroke_scene::position(double t) const {
  const double s = std::clamp((t - approach) / stroke, 0.0, 1.0);
  double depth = 0.002 - 0.001 * std::cos(4.0 * std::acos(-1.0) * s);
  if (t < approach) depth -= 0.006 * smooth(1.0 - t / approach);
  if (t > approach + stroke) depth -= 0.006 * smooth((t - approach - stroke) / leave);
  const double place = s * static_cast<double>(path_.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), path_.size() - 2);
  const double w = place - static_cast<double>(i);
  const point_on_surface &a = path_[i], &b = path_[i + 1];
  const vector3 normal = ((1.0 - w) * a.normal + w * b.normal).normalized();
  return (1.0 - w) * a.point + w * b.point - depth * normal;
}

/// The highest point of the surface above or below `foot`, with the normal interpolated from its
/// vertices, so that the path has no kinks of its own; none where there is not enough body below it.
std::optional<stroke_scene::point_on_surface> stroke_scene::top_over(const vector3& foot) const {
  const Eigen::Index u = (up_ + 1) % 3, v = (up_ + 2) % 3;
  const double upright = 1e-12 * box_.sizes()(u) * box_.sizes()(v);  // seen from above: no area
  point_on_surface top;
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  for (const auto& t : surface_) {
    const auto [a, b, c] = env::corners(t, mesh().nodes);
    const double area = (b(u) - a(u)) * (c(v) - a(v)) - (b(v) - a(v)) * (c(u) - a(u));
    if (std::abs(area) < upright) continue;
    const double wb = ((foot(u) - a(u)) * (c(v) - a(v)) - (foot(v) - a(v)) * (c(u) - a(u))) / area;
    const double wc = ((b(u) - a(u)) * (foot(v) - a(v)) - (b(v) - a(v)) * (foot(u) - a(u))) / area;
    if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
    const vector3 p = (1.0 - wb - wc) * a + wb * b + wc * c;
    lowest = std::min(lowest, p(up_));
    if (p(up_) <= highest) continue;
    highest = p(up_);
    const vector3 n = (1.0 - wb - wc) * vertex_normals_[static_cast<std::size_t>(t.nodes[0])] +
                      wb * vertex_normals_[static_cast<std::size_t>(t.nodes[1])] +
                      wc * vertex_normals_[static_cast<std::size_t>(t.nodes[2])];
    top = {p, n.normalized()};
  }
  if (!(highest - lowest >= least_body)) return std::nullopt;
  return top;
}

}  // namespace experiments
