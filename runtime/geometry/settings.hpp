#pragma once

#include <limits>

namespace floornav {

/// What a configuration value may be; bounds are inclusive.
struct Allowed {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// A component's settings are a plain struct with defaults. Beside it stands
//
//   template <class Visitor>
//   void visit_settings(Visitor& visit, RoiSettings& s) {
//     visit("x_max_m", s.x_max_m, Allowed{0.1, 20.0});   // number: key = member's name, with its unit
//     visit("sections", s.sections);                      // a nested struct with its own visit_settings
//     visit("search", s.search, {"auto", "window"});      // std::string out of a list
//   }
//
// so that runtime/process maps it to YAML one to one without the core knowing of YAML.

}  // namespace floornav
