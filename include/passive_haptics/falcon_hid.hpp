// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Novint Falcon adapter: what a haptic loop needs of it. HID means haptic interface device: the
// Falcon is no USB-HID-class device but a serial bridge with a motor controller behind it
// (falcon/transport.hpp). docs/falcon.md says how to begin.
//
//     falcon::device<falcon::libusb_transport> grip{falcon::cautious_gain<double>};
//     open(), start(), home(), then once a tick:   sample = grip.exchange(force)
//
// Without libusb's header there is no libusb_transport, and all the rest. By name, for who wants them:
//
//     falcon/boot.hpp                   boot(grip, image): the program that is gone at every power-off
//     falcon/runner.hpp                 a thread for the loop
//     falcon/recording.hpp              a session kept and played again; recording_file.hpp: as CSV
//     falcon/in_memory_transport.hpp    a cable to what is simulated; mock.hpp: a simulated Falcon

#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/libusb_transport.hpp>
