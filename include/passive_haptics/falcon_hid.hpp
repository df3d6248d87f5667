// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Novint Falcon adapter for a haptic loop. HID means haptic interface device: the Falcon is no USB-HID-class device
// but a serial bridge with a motor controller behind it (falcon/transport.hpp). docs/falcon.md says how to begin.
//
//     falcon::device<falcon::libusb_transport> grip{falcon::cautious_gain<double>};
//     open(), start(), home(), then once a tick:   sample = grip.exchange(force)
//
// Without libusb's header everything but libusb_transport is available. Headers to include by name:
//
//     falcon/boot.hpp                   boot(grip, image): loads the firmware, which is lost at power-off
//     falcon/runner.hpp                 a thread for the loop
//     falcon/recording.hpp              records and replays a session; recording_file.hpp: as CSV
//     falcon/in_memory_transport.hpp    a transport to a simulated device; mock.hpp: a simulated Falcon

#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/libusb_transport.hpp>
