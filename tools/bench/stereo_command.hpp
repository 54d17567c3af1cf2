#pragma once

namespace CLI {
class App;
}

namespace floornav {

/// `floornav-bench stereo`: what rectifying and matching costs and how good it is, beside OpenCV's plain
/// calls.
void add_stereo_command(CLI::App& app);

}  // namespace floornav
