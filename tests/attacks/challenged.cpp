// SPDX-License-Identifier: BSD-3-Clause
#include "attacks/challenged.hpp"

template sim::detail::run_outcome sim::detail::attack(const sim::subject<d1>&, sim::adversary,
                                                      const sim::circumstances&, std::uint64_t,
                                                      const spectator<d1>&);
template sim::detail::run_outcome sim::detail::attack(const sim::subject<d2>&, sim::adversary,
                                                      const sim::circumstances&, std::uint64_t,
                                                      const spectator<d2>&);
template sim::detail::run_outcome sim::detail::attack(const sim::subject<d3>&, sim::adversary,
                                                      const sim::circumstances&, std::uint64_t,
                                                      const spectator<d3>&);
