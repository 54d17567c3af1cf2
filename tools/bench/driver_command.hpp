#pragma once

namespace CLI {
class App;
}

namespace floornav {

/// `floornav-bench driver`: what the Kinect driver costs, and how long a frame takes through it.
void add_driver_command(CLI::App& app);

}  // namespace floornav
