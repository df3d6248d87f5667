// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// How often operator new has been called in this thread.
long allocations();
