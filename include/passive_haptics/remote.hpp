// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An environment on another machine: it sends the surface that is touched, the local model stays at the
// device. The menu:
//
//   remote/wire.hpp         the datagram: 152 bytes, little-endian, versioned, checked; encode, decode
//   remote/content.hpp      plane, quadric and probe to numbers and back
//   remote/session.hpp      what both ends share: two random numbers, order, counts
//   remote/siphash.hpp      SipHash-2-4, a keyed hash
//   remote/seal.hpp         authenticates every datagram, where both ends share a key
//   remote/client.hpp       the device's end: asks, keeps the last good answer
//   remote/server.hpp       the environment's end: hears, answers, one client at a time
//   remote/udp_socket.hpp   carries the bytes on POSIX systems
//
//   device ─▶ local model ─▶ force      1 kHz, here: passive whatever the network does
//      │           ▲
//      │ position  │ surface, as old as the network makes it
//      ▼           │
//   client ◀──── UDP ────▶ server ◀──▶ environment      50 to 200 Hz
//
// The hand is protected and the far side is not: nothing limits what the environment does with a position that
// comes late or never. Where it must be protected, too (a robot, a second hand), a two-port has to cross the
// network, and both ends count energy: two_port.hpp, in sessions of this room. docs/remote.md has the format,
// what is guaranteed and what is not, and what each of the two costs.

#include <passive_haptics/remote/client.hpp>
#include <passive_haptics/remote/content.hpp>
#include <passive_haptics/remote/seal.hpp>
#include <passive_haptics/remote/server.hpp>
#include <passive_haptics/remote/session.hpp>
#include <passive_haptics/remote/siphash.hpp>
#include <passive_haptics/remote/udp_socket.hpp>
#include <passive_haptics/remote/wire.hpp>
