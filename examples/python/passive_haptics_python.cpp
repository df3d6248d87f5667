// SPDX-License-Identifier: BSD-3-Clause
// A Python module for what-if questions and plots: a simulated device, a hand, a wall, and a composition by
// its name in the C interface; and a probe on meshes. Traces come back as NumPy arrays. Not for a servo loop: Python
// keeps no millisecond.

#include <passive_haptics/adapters/c/passive_haptics.h>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace {

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace py = pybind11;
using line = ph::space<double, 1>;

/// The device as it is, and as it is stated to the composition unless another one is.
struct device_facts {
  double mass = 0.1;         // [kg]
  double damping = 0.03;     // [N·s/m]
  double friction = 0.0;     // dry [N]
  double presliding = 0.0;   // over which that is elastic [m]
  double quantum = 0.0;      // step of the encoder [m]
  double force_limit = 9.0;  // [N]
  double period = 1e-3;      // of the loop [s]
  int latency = 0;           // [ticks]
};

/// Follows a target as a spring and damper, no stronger than its limit, and may let go.
struct hand_model {
  double stiffness = 200.0;  // [N/m]
  double damping = 2.0;      // [N·s/m]
  double limit = 5.0;        // [N]
  double start = 0.02;       // where the device is at first; the wall is below 0 [m]
  double target = -0.01;     // [m]
  double lets_go = std::numeric_limits<double>::infinity();  // at that time [s]
  double load = 0.0;  // constant force beside the hand, a weight [N]
};

struct trace {
  std::vector<double> t, x, force, depth, port_energy, ledger;
  std::vector<int> event;
};

ph_parameters stated(const device_facts& d, const hand_model& hand) {
  ph_parameters p{};
  p.size = sizeof p;
  if (d.latency < 0) throw py::value_error("latency is negative");
  p.latency = static_cast<std::uint32_t>(d.latency);
  p.mass = d.mass;
  p.damping = d.damping;
  p.hand_force = hand.limit + std::abs(hand.load) + d.friction;
  p.force_limit = d.force_limit;
  p.longest_tick = d.period * 1.000001;  // of a clock that is exact but for rounding
  p.friction = d.friction;
  p.presliding = d.presliding;
  p.quantum = d.quantum;
  return p;
}

/// What C gives back with one function of its own.
template <auto Destroy>
struct ends {
  void operator()(auto* one) const noexcept { Destroy(one); }
};

/// What presses back: a composition, or the bare spring.
class wall {
 public:
  wall(const std::string& composition, ph_parameters parameters, double stiffness, double pitch)
      : stiffness_(stiffness),
        bare_(composition == "none"),
        guards_(composition.find("guard") != std::string::npos),
        clicks_(composition.find("detents") != std::string::npos) {
    parameters.pitch = pitch;
    parameters.detent_stiffness = stiffness;
    if (bare_) return;
    const bool meshes = composition.find("mesh") != std::string::npos;
    if (meshes || composition == "stylus" || composition == "tool") {
      throw py::value_error("composition = \"" + composition + "\" is refused: " +
                            (meshes ? "the simulated wall is a plane; a Probe touches a Mesh"
                                    : "it turns, and the simulated hand moves on a line"));
    }
    std::array<char, PH_TEXT_ROOM> why{};
    ph_port* port = nullptr;
    if (ph_create(composition.c_str(), &parameters, &port, why.data(), why.size()) != PH_OK) {
      throw py::value_error(why.data());
    }
    port_.reset(port);
    const std::array point{0.0, 0.0, 0.0};
    const std::array up{0.0, 0.0, 1.0};
    if (!guards_ && !clicks_ &&
        ph_publish_plane(port, point.data(), up.data(), stiffness) != PH_OK) {
      throw py::value_error("stiffness = " + std::to_string(stiffness) + " is refused: > 0 N/m");
    }
  }

  [[nodiscard]] ph_result tick(double x, double dt) noexcept {
    ph_result out{};
    out.size = sizeof out;
    const std::array position{0.0, 0.0, x};
    const std::array spring{0.0, 0.0, x < 0.0 ? -stiffness_ * x : 0.0};
    if (bare_) {
      out.force[2] = spring[2];
      out.depth = x < 0.0 ? -x : 0.0;
    } else if (guards_) {
      (void)ph_tick_wanted(port_.get(), position.data(), dt, spring.data(), &out);
    } else if (clicks_) {
      const std::array along{x, 0.0, 0.0};
      (void)ph_tick(port_.get(), along.data(), dt, &out);
      out.force[2] = out.force[0];
    } else {
      (void)ph_tick(port_.get(), position.data(), dt, &out);
    }
    return out;
  }

 private:
  double stiffness_;
  bool bare_, guards_, clicks_;
  std::unique_ptr<ph_port, ends<ph_destroy>> port_;
};

template <class Device>
trace run(Device device, wall& touched, double period, double seconds, double lets_go) {
  trace all;
  auto sample = device.exchange(0.0);
  for (long n = std::lround(seconds / period); n > 0; --n) {
    if (device.time() >= lets_go) device.hand().limit = 0.0;
    const ph_result out = touched.tick(sample.position, sample.dt);
    all.t.push_back(device.time());
    all.x.push_back(device.position());
    all.force.push_back(out.force[2]);
    all.depth.push_back(out.depth);
    all.port_energy.push_back(device.meter().with_friction());
    all.ledger.push_back(out.energy);
    all.event.push_back(out.event);
    sample = device.exchange(out.force[2]);
  }
  return all;
}

template <class Number>
py::array_t<Number> array(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::dict simulate(const std::string& composition, double stiffness, const device_facts& device,
                  const hand_model& hand, const device_facts* told, double seconds, double pitch) {
  if (!(seconds > 0.0 && seconds / device.period < 1e8)) {
    throw py::value_error("seconds = " + std::to_string(seconds) + " is refused: > 0 s");
  }
  wall touched(composition, stated(told != nullptr ? *told : device, hand), stiffness, pitch);
  const sim::device_parameters<line> simulated{
      .mass = device.mass,
      .damping = device.damping,
      .friction = device.presliding > 0.0 ? 0.0 : device.friction,
      .force_limit = device.force_limit,
      .quantum = device.quantum,
      .load = hand.load,
      .period = device.period,
      .start = hand.start,
      .latency = device.latency};
  const sim::impedance_hand<line> person{.stiffness = hand.stiffness,
                                         .damping = hand.damping,
                                         .limit = hand.limit,
                                         .target = hand.target};
  const auto refuse = [](const ph::parameter_fault& fault) {
    if (!fault) return;
    throw py::value_error(std::string(fault.parameter) + " = " + std::to_string(fault.value) +
                          " is refused: " + fault.remedy);
  };
  trace all;
  if (device.presliding > 0.0) {
    const sim::slider_and_spring friction{.level = {device.friction},
                                          .presliding = {device.presliding}};
    const sim::device<line, sim::impedance_hand<line>, sim::slider_and_spring> grip(
        simulated, person, friction);
    refuse(grip.check());
    const py::gil_scoped_release others_may_run;
    all = run(grip, touched, device.period, seconds, hand.lets_go);
  } else {
    const sim::device<line, sim::impedance_hand<line>> grip(simulated, person);
    refuse(grip.check());
    const py::gil_scoped_release others_may_run;
    all = run(grip, touched, device.period, seconds, hand.lets_go);
  }
  py::dict traces;
  traces["t"] = array(all.t);
  traces["x"] = array(all.x);
  traces["force"] = array(all.force);
  traces["depth"] = array(all.depth);
  traces["port_energy"] = array(all.port_energy);
  traces["ledger"] = array(all.ledger);
  traces["event"] = array(all.event);
  return traces;
}

py::tuple budget(const device_facts& device) {
  const ph_parameters p = stated(device, {});
  double stiffness = 0.0;
  const char* because = "";
  if (ph_stiffness_budget(&p, &stiffness, &because) != PH_OK) throw py::value_error(because);
  return py::make_tuple(stiffness, because);
}

template <class Number>
using table = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// A table of rows of three.
template <class Number>
std::uint32_t rows_of(const table<Number>& numbers, const char* name) {
  if (numbers.ndim() != 2 || numbers.shape(1) != 3) {
    throw py::value_error(std::string(name) + " is refused: rows of three numbers");
  }
  return static_cast<std::uint32_t>(numbers.shape(0));
}
/// Makes an exception of what C has refused.
template <class Call>
void checked(Call call) {
  std::array<char, PH_TEXT_ROOM> why{};
  const std::int32_t status = call(why.data(), why.size());
  if (status != PH_OK) throw py::value_error(why[0] != 0 ? why.data() : ph_status_text(status));
}

class triangles {
 public:
  triangles(const table<double>& vertices, const table<std::int32_t>& corners) {
    ph_mesh_data data{};
    data.size = sizeof data;
    data.vertex_count = rows_of(vertices, "vertices");
    data.triangle_count = rows_of(corners, "triangles");
    data.vertices = vertices.data();
    data.triangles = corners.data();
    ph_mesh* made = nullptr;
    checked([&](char* why, std::size_t room) { return ph_mesh_create(&data, &made, why, room); });
    mesh_.reset(made);
  }
  void update(const table<double>& vertices) {
    const std::uint32_t count = rows_of(vertices, "vertices");
    checked([&](char* why, std::size_t room) {
      return ph_mesh_update(mesh_.get(), vertices.data(), count, why, room);
    });
  }
  [[nodiscard]] const ph_mesh* get() const noexcept { return mesh_.get(); }

 private:
  std::unique_ptr<ph_mesh, ends<ph_mesh_destroy>> mesh_;
};

class ball {
 public:
  ball(double radius, double friction) {
    ph_probe_parameters p{};
    p.size = sizeof p;
    p.radius = radius;
    p.friction = friction;
    ph_probe* made = nullptr;
    checked([&](char* why, std::size_t room) { return ph_probe_create(&p, &made, why, room); });
    probe_.reset(made);
  }
  void touch(const triangles& mesh) {
    checked([&](char*, std::size_t) { return ph_probe_touch(probe_.get(), mesh.get()); });
  }
  /// Where it is after a step, and how far and in which direction it is held off.
  py::tuple step(const std::array<double, 3>& position, double dt) {
    ph_probe_result r{};
    r.size = sizeof r;
    checked(
        [&](char*, std::size_t) { return ph_probe_step(probe_.get(), position.data(), dt, &r); });
    return py::make_tuple(py::array_t<double>(3, r.place), r.depth,
                          py::array_t<double>(3, r.normal));
  }

 private:
  std::unique_ptr<ph_probe, ends<ph_probe_destroy>> probe_;
};

/// A class of numbers with names: Device(mass=0.1), d.mass, d.mass = 0.2.
template <class Numbers, class... Members>
void numbers(py::module_& module, const char* name, const char* text,
             const std::pair<const char*, Members>&... members) {
  py::class_<Numbers> type(module, name, text);
  type.def(py::init([](const py::kwargs& given) {
    const py::object made = py::cast(Numbers{});
    for (const auto& [key, value] : given) {
      if (!py::hasattr(made, key))
        throw py::type_error("no parameter " + std::string(py::str(key)));
      py::setattr(made, key, value);
    }
    return made.cast<Numbers>();
  }));
  (type.def_readwrite(members.first, members.second), ...);
}

}  // namespace

PYBIND11_MODULE(passive_haptics, module) {
  module.doc() =
      "What a hand feels of a wall under each composition of passive_haptics, simulated.";
  numbers<device_facts>(
      module, "Device",
      "mass kg, damping N s/m, friction N, presliding m, quantum m, force_limit N, "
      "period s, latency ticks",
      std::pair{"mass", &device_facts::mass}, std::pair{"damping", &device_facts::damping},
      std::pair{"friction", &device_facts::friction},
      std::pair{"presliding", &device_facts::presliding},
      std::pair{"quantum", &device_facts::quantum},
      std::pair{"force_limit", &device_facts::force_limit},
      std::pair{"period", &device_facts::period}, std::pair{"latency", &device_facts::latency});
  numbers<hand_model>(
      module, "Hand",
      "stiffness N/m, damping N s/m, limit N, start m, target m, lets_go s, load N; the "
      "wall is below 0",
      std::pair{"stiffness", &hand_model::stiffness}, std::pair{"damping", &hand_model::damping},
      std::pair{"limit", &hand_model::limit}, std::pair{"start", &hand_model::start},
      std::pair{"target", &hand_model::target}, std::pair{"lets_go", &hand_model::lets_go},
      std::pair{"load", &hand_model::load});
  module.def(
      "simulate", &simulate, py::arg("composition"), py::arg("stiffness"),
      py::arg("device") = device_facts{}, py::arg("hand") = hand_model{},
      py::arg("stated") = static_cast<const device_facts*>(nullptr), py::arg("seconds") = 2.0,
      py::arg("pitch") = 5e-3,
      "A wall of `stiffness` N/m under a composition of ph_create, or \"none\": a bare spring. "
      "Guards bound that spring; detents are `pitch` m apart, of that stiffness. `stated`: the "
      "device as it is told to the composition, if "
      "another. Arrays t s, x m (true), force N (commanded), depth m, port_energy J (the "
      "simulator's own books, dry friction included), ledger J, event.");
  module.def("stiffness_budget", &budget, py::arg("device"),
             "(N/m, why): how stiff a wall may be before the ledger of this device runs dry.");
  py::class_<triangles>(module, "Mesh",
                        "Triangles to touch, with vertices in m, from arrays of rows.")
      .def(py::init<const table<double>&, const table<std::int32_t>&>(), py::arg("vertices"),
           py::arg("triangles"))
      .def("update", &triangles::update, py::arg("vertices"), "Moves all vertices [m].");
  py::class_<ball>(module, "Probe", "A ball that is drawn to a place and passes through no mesh.")
      .def(py::init<double, double>(), py::arg("radius") = 5e-4, py::arg("friction") = 0.0)
      .def("touch", &ball::touch, py::arg("mesh"))
      .def("step", &ball::step, py::arg("position"), py::arg("dt") = 1e-3,
           "(place m, depth m, normal): where the ball is, and how it is held off.");
  module.def(
      "event_text", [](int event) { return ph_event_text(event); }, py::arg("event"));
  module.attr("compositions") =
      py::make_tuple("touch", "encoder_touch", "strict_touch", "strict_encoder_touch", "contacts",
                     "encoder_contacts", "strict_contacts", "strict_encoder_contacts", "guard",
                     "encoder_guard", "strict_guard", "strict_encoder_guard", "quantised_touch");
  module.attr("detents") =
      py::make_tuple("detents", "encoder_detents", "strict_detents", "strict_encoder_detents");
}
