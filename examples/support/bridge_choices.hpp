// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bridge_tables.hpp"
#include "options.hpp"

#include "tetrapore/law/bridge/lambert.hpp"
#include "tetrapore/law/bridge/mikami.hpp"
#include "tetrapore/law/bridge/rabinovich.hpp"
#include "tetrapore/law/bridge/soulie.hpp"
#include "tetrapore/law/bridge/toroid.hpp"
#include "tetrapore/law/bridge/weigert_ripperger.hpp"
#include "tetrapore/law/bridge/willett.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>

/// \file
/// The laws of a bridge that can be chosen on a command line, and what they answer in one form.

namespace support {

namespace tp = tetrapore;

/// A bridge, as far as its law knows it: what it does not know is NaN.
struct bridge_answer {
  tp::bridge_status reason = tp::bridge_status::not_converged;
  double force = 0;     ///< [N]
  double volume = 0;    ///< [m³]
  double suction = 0;   ///< [Pa]
  double contact1 = 0;  ///< radius of the contact line on the first grain [m]
  double contact2 = 0;  ///< on the second, or on the wall [m]
};

using bridge_law_of_the_job =
    std::variant<tp::young_laplace<>, tabulated_pairs, tp::toroid<>, tp::willett<>, tp::willett_small<>, tp::lambert<>,
                 tp::rabinovich<>, tp::soulie<>, tp::weigert_ripperger<>, tp::mikami<>>;

inline constexpr std::array<const char*, std::variant_size_v<bridge_law_of_the_job>> bridge_laws{
    "exact",   "table",      "toroid", "willett",           "willett_small",
    "lambert", "rabinovich", "soulie", "weigert_ripperger", "mikami"};

[[nodiscard]] inline std::string bridge_law_names() {
  std::string all;
  for (const char* name : bridge_laws) {
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  return all;
}

template <class Law>
inline constexpr bool takes_suction = tp::bridge_law<Law, double, tp::given_suction<double>>;

/// A law for one material. \param angle  [rad]
template <class Law>
[[nodiscard]] Law law_for(double tension, double angle) {
  if constexpr (std::same_as<Law, tabulated_pairs>) {
    return {nullptr};  // its tables are made when the pairs are known
  } else if constexpr (requires(Law l) { l.contact_angle1; }) {
    return Law{.surface_tension = tension, .contact_angle1 = angle, .contact_angle2 = angle};
  } else if constexpr (requires(Law l) { l.contact_angle; }) {
    return Law{.surface_tension = tension, .contact_angle = angle};
  } else {
    return Law{.surface_tension = tension};  // knows perfect wetting alone
  }
}

/// The law of a name, for one material. \param angle  [rad]
[[nodiscard]] inline bridge_law_of_the_job bridge_law_named(const std::string& name, double tension, double angle) {
  const auto at = std::find(bridge_laws.begin(), bridge_laws.end(), name);
  if (at == bridge_laws.end()) {
    refuse("--law", name, "one of " + bridge_law_names());
  }
  const auto wanted = static_cast<std::size_t>(at - bridge_laws.begin());
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    std::optional<bridge_law_of_the_job> law;
    ((I == wanted ? void(law = law_for<std::variant_alternative_t<I, bridge_law_of_the_job>>(tension, angle)) : void()),
     ...);
    return *law;
  }(std::make_index_sequence<bridge_laws.size()>());
}

/// Whether a law comes from tables, which are made from the exact one when the pairs are known.
[[nodiscard]] inline bool is_tabulated(const bridge_law_of_the_job& law) {
  return std::holds_alternative<tabulated_pairs>(law);
}

/// Refuses a name that is none, and a law that is asked for what it does not know. \param angle  [rad]
inline void check_bridge_law(const std::string& name, bool by_suction, double angle) {
  std::visit(
      [&]<class Law>(const Law&) {
        if (by_suction && !takes_suction<Law>) {
          refuse("--law", name, "with --suction a law that takes one, exact or toroid; the others take --volume");
        }
        if (angle > 0 && std::same_as<Law, tp::mikami<>>) {
          refuse("--law", name, "with a contact angle a law that knows it");
        }
      },
      bridge_law_named(name, 1, angle));
}

namespace detail {

/// Radius of the upright cylinder between two spheres, or a sphere and a plane, that holds a volume of liquid with
/// them.
[[nodiscard]] inline double cylinder_radius(const tp::edge<double>& e, double volume) {
  const auto held = [&](double radius) {
    double height = e.gap;
    double solid = 0;
    for (const double r : {e.radius1, e.radius2}) {
      if (r < std::numeric_limits<double>::infinity()) {
        const double cap = radius * radius / (r + std::sqrt(r * r - radius * radius));
        height += cap;
        solid += tp::pi<double> / 3 * cap * cap * (3 * r - cap);
      }
    }
    return tp::pi<double> * radius * radius * height - solid;
  };
  double low = 0;
  double high = std::min(e.radius1, e.radius2);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (held(middle) < volume ? low : high) = middle;
  }
  return high;
}

}  // namespace detail

/// Asks a law for a bridge; grains that overlap pull as grains that touch.
template <class Law, class Given>
[[nodiscard]] bridge_answer bridge_of(const Law& law, const tp::edge<double>& e, const Given& given) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto found = tp::held_at_contact<Law>{law}.bridge(e, given);
  const auto& m = found.value;
  bridge_answer a{found.reason, m.force, found.ok() ? given.value : 0.0, unknown, unknown, unknown};
  if constexpr (requires { m.filling1; }) {
    a.volume = m.volume;
    a.suction = m.suction;
    a.contact1 = m.contact1;
    a.contact2 = m.contact2;
  }
  return a;
}

/// Gives a bridge whose law knows the force alone the contact lines of an upright cylinder of the same volume.
inline void stand_in_a_cylinder(const tp::edge<double>& e, bridge_answer& a) {
  if (a.reason == tp::bridge_status::ok && std::isnan(a.contact1)) {
    a.contact1 = a.contact2 = detail::cylinder_radius(e, a.volume);
  }
}

}  // namespace support
