// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a device is, measured on it: before a promise rests on numbers, let it say them itself.
//
//   identify.hpp               identify<P>(device): every axis, in a loop of its own
//   axis_identification.hpp    tick(position, dt) → force, then result(): one axis, in yours
//   axis_found.hpp             the bounds, and stated(), what a promise may rest on
//   describe.hpp               a table, the composition to paste, its stiffness budget
//   recording_file.hpp         load_recording(): what somebody has logged; CSV, MAT 5, NumPy
//   recorded_device.hpp        the numbers that a recording bears
//   replay.hpp                 the falsifier: is a ledger told too much?
//   identification_file.hpp    save(), load(): what was found
//   device_file.hpp            save_device(), load_device(): what a composition is told, in JSON
//
// The method, what it has been tried on and what it cannot find: docs/design/identification.md.

#include <passive_haptics/identification/describe.hpp>
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/identification/identification_file.hpp>
#include <passive_haptics/identification/identify.hpp>
#include <passive_haptics/identification/recording_file.hpp>
#include <passive_haptics/identification/replay.hpp>
