// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Identification of a device: measures the numbers on which a guarantee rests.
//
//   identify.hpp               identify<P>(device): every axis, in a loop of its own
//   axis_identification.hpp    tick(position, dt) → force, then result(): one axis, in yours
//   axis_found.hpp             the bounds found, and stated(), the numbers for a composition
//   weigh_in.hpp               weigh(device, ...): force delivered for one commanded; known_gains.hpp divides by it
//   describe.hpp               a table, the composition to paste, its stiffness budget
//   in_numbers.hpp             what explain() says, with numbers, and by how much what raises it has to change
//   recording_file.hpp         load_recording(): a log of a device; CSV, MAT 5, NumPy
//   recorded_device.hpp        the numbers that follow from a recording
//   replay.hpp                 a falsifier: tests whether a ledger claims more energy than a recording has
//   identification_file.hpp    save(), load(): the result of an identification
//   device_file.hpp            save_device(), load_device(): the device of a composition, in JSON
//
// docs/design/identification.md has the method, the devices it was tried on, and its limits.

#include <passive_haptics/identification/describe.hpp>
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/identification/identification_file.hpp>
#include <passive_haptics/identification/identify.hpp>
#include <passive_haptics/identification/in_numbers.hpp>
#include <passive_haptics/identification/recording_file.hpp>
#include <passive_haptics/identification/replay.hpp>
#include <passive_haptics/identification/weigh_in.hpp>
