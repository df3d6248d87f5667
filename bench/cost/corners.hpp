// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The hardest corners for the solver of a contact_set (contact/proxy_solver.hpp) that a search has found: from one tick
// to the next the device moves from `before` to `now`, and the solver tries so many sets of pressing planes in it. From
// the hardest of 75 000 random corners it was climbed by 300 000 changes, 40 times for six planes and 30 for sixteen.

#include <array>

namespace cost {

template <int Planes>
struct corner {
  /// A normal of any length, and how far the plane is from the origin along it [µm].
  std::array<std::array<int, 4>, static_cast<std::size_t>(Planes)> planes;
  std::array<int, 3> before, now;  ///< places of the device [µm]
};

template <int Planes>
inline constexpr corner<Planes> hardest{};
/// All seven sets, in closed form.
template <>
inline constexpr corner<3> hardest<3>{
    {{{-4, 108, 12, 70}, {-129, 59, 86, 134}, {14, -55, 12, -520}}},
    {3117, -5258, 995},
    {4206, -4587, -3274}};
/// 17 sets; it would stop at 24.
template <>
inline constexpr corner<6> hardest<6>{{{{83, 79, 27, -786},
                                        {-75, 120, 25, 274},
                                        {-60, 21, 87, 775},
                                        {58, -80, 36, -73},
                                        {-70, -27, 84, 796},
                                        {-2, -13, 126, 502}}},
                                      {7423, 2557, 2659},
                                      {599, -1, -7627}};
/// 25 sets; it would stop at 64.
template <>
inline constexpr corner<16> hardest<16>{{{{39, 25, 79, 748},
                                          {69, 53, 10, 402},
                                          {-47, -71, 43, 32},
                                          {-37, 54, 10, 421},
                                          {67, -95, 62, -469},
                                          {30, 83, 66, -283},
                                          {-46, -26, 76, -842},
                                          {-30, -11, 100, 810},
                                          {-14, -90, 22, -22},
                                          {-80, -81, 55, 47},
                                          {82, 56, 37, 695},
                                          {-31, 63, 46, 919},
                                          {-56, -73, 37, -1},
                                          {46, 21, 48, 894},
                                          {-54, -64, 43, 62},
                                          {44, 68, 55, -902}}},
                                        {2096, -720, -4744},
                                        {-3436, 3529, -6567}};

}  // namespace cost
