#include "runtime/process/daemon.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/live_executor.hpp"
#include "runtime/process/recording_transport.hpp"
#include "runtime/process/stop_signals.hpp"

namespace floornav {
namespace {

void say(const DaemonInfo& info, const std::string& line) {
  fmt::print(stderr, "{}: {}\n", info.name, line);
}

std::string examples(const DaemonInfo& info) {
  return fmt::format(
      "Examples:\n"
      "  {0} --config robot.yaml\n"
      "  {0} --print-config > robot.yaml           every setting of this program, with what is allowed\n"
      "  {0} --config robot.yaml --replay          beside lcm-logplayer, on a bus of their own\n",
      info.name);
}

}  // namespace

std::optional<int> parse_options(int argc, const char* const* argv, const DaemonInfo& info, bool parallel,
                                 DaemonOptions& options) {
  CLI::App app(info.about, info.name);
  app.footer(examples(info));
  app.set_version_flag("--version", info.name + " " FLOORNAV_VERSION);
  app.add_option("--config", options.config, "YAML file that describes the robot")->type_name("FILE");
  app.add_option("--lcm-url", options.lcm_url,
                 fmt::format("LCM bus; default: LCM_DEFAULT_URL, else {}", kDefaultLcmUrl))
      ->type_name("URL");
  app.add_option("--record", options.record, "write what this program publishes to an LCM log too")
      ->type_name("LOG");
  app.add_flag("--replay", options.log_time, "take the time from the messages: a log is played on this bus");
  app.add_flag("--print-config", options.print_config, "print the settings in force as YAML and end");
  if (parallel) {
    options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    app.add_option("--threads", options.threads, "worker threads")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
  }
  info.add_options(app);
  try {
    app.parse(argc, argv);
    if (options.config.empty() && !options.print_config)
      throw CLI::RequiredError("--config FILE (--print-config prints one to begin with)");
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    say(info, line);
    return 1;
  }
  return std::nullopt;
}

void run_on_bus(const DaemonInfo& info, const DaemonOptions& options, Node& node, std::int64_t config_hash) {
  std::signal(SIGPIPE, SIG_IGN);  // a broken connection is an error code, not the end
  const std::string url = lcm_url(options.lcm_url);
  LcmTransport lcm(url);
  std::optional<RecordingTransport> recording;
  if (!options.record.empty())
    recording.emplace(lcm, options.record, [&](const std::string& line) { say(info, line); });
  Transport& transport = recording ? static_cast<Transport&>(*recording) : lcm;
  if (const auto warning = receive_buffer_warning(url)) say(info, *warning);
  LiveExecutor executor(node, transport,
                        {.log_time = options.log_time,
                         .config_hash = config_hash,
                         .log = [&](const std::string& line) { say(info, line); }});
  const std::atomic<bool>& stop = stop_on_signals();
  say(info, "running on " + url);
  executor.run(stop);
  say(info, "stopped");
}

int exit_code_of(const DaemonInfo& info, const std::function<void()>& run) {
  try {
    run();
    return 0;
  } catch (const std::exception& error) {
    say(info, error.what());
    return 1;
  }
}

}  // namespace floornav
