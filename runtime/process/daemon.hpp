#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/geometry/parallel.hpp"
#include "runtime/process/node.hpp"
#include "runtime/process/settings_reader.hpp"
#include "runtime/process/settings_writer.hpp"
#include "runtime/process/thread_pool.hpp"

namespace CLI {
class App;
}

namespace floornav {

/// What `--help` tells of a daemon.
struct DaemonInfo {
  std::string name;   ///< of the program, e.g. "floornav-perception"
  std::string about;  ///< what it does, with its channels
  /// Adds the program's own options.
  std::function<void(CLI::App&)> add_options = [](CLI::App&) {};
};

/// The command line of every daemon.
struct DaemonOptions {
  std::string config;
  std::string lcm_url;
  std::string record;  ///< log of what the daemon publishes
  bool log_time = false;
  bool print_config = false;
  int threads = 1;
};

/// Fills in the options. An exit code where there is nothing more to do: help, version, or a mistake told in
/// one line. `parallel`: the daemon has work for more than one thread.
std::optional<int> parse_options(int argc, const char* const* argv, const DaemonInfo& info, bool parallel,
                                 DaemonOptions& options);

/// Runs the node on the bus until SIGTERM or SIGINT. Throws TransportError where there is no bus.
void run_on_bus(const DaemonInfo& info, const DaemonOptions& options, Node& node, std::int64_t config_hash);

/// Calls `run`; what it throws becomes one line on stderr and exit code 1.
int exit_code_of(const DaemonInfo& info, const std::function<void()>& run);

/// The whole main() of a daemon: `Settings` is a struct of the robot file's sections that it needs, `make`
/// makes the node, as make(settings) or, where it has work for several threads, make(settings, Parallel&).
template <class Settings, class Make>
int run_daemon(int argc, const char* const* argv, const DaemonInfo& info, Make make) {
  constexpr bool kParallel = std::is_invocable_v<Make, const Settings&, Parallel&>;
  DaemonOptions options;
  if (const auto code = parse_options(argc, argv, info, kParallel, options)) return *code;
  return exit_code_of(info, [&] {
    Settings settings;
    if (!options.config.empty()) read_robot_file(options.config, settings);
    if (options.print_config) {
      fmt::print("{}", settings_text(settings));
      return;
    }
    ThreadPool pool(options.threads);
    std::unique_ptr<Node> node;
    if constexpr (kParallel) {
      node = make(settings, pool);
    } else {
      node = make(settings);
    }
    run_on_bus(info, options, *node, settings_hash(settings));
  });
}

}  // namespace floornav
