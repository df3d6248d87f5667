// SPDX-License-Identifier: BSD-3-Clause
// Nothing of its own: it is what precompiled.hpp is compiled for.
