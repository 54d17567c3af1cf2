#include "tools/replay/summary.hpp"

#include <array>

#include <nlohmann/json.hpp>

#include "runtime/process/health.hpp"
#include "runtime/process/settings_writer.hpp"
#include "tools/replay/text_file.hpp"

namespace floornav {

namespace {

using Json = nlohmann::ordered_json;

double milliseconds(std::chrono::nanoseconds span) {
  return std::chrono::duration<double, std::milli>(span).count();
}

Json path_of(const Summary& s) {
  Json path;
  const auto& last = s.observer.path();
  path["status"] = last ? path_status_name(last->status) : "none";
  path["reason"] = last ? last->reason : "no path was published";
  path["length_m"] = last ? last->length : 0;
  path["points"] = last ? last->n_points : 0;
  if (s.request.goal) path["goal"] = {s.request.goal->x(), s.request.goal->y()};
  return path;
}

Json map_of(const Summary& s) {
  const MapArea area = area_of(s.map);
  return {{"area_m2", area.seen_m2()},
          {"free_m2", area.free_m2},
          {"blocked_m2", area.blocked_m2},
          {"resolution_m", s.map.cells.resolution_m},
          {"epoch", s.observer.map().map().epoch},
          {"version", s.observer.map().map().version}};
}

Json log_of(const Summary& s) {
  return {{"events", s.log.events},
          {"clouds", s.log.clouds},
          {"seconds", static_cast<double>(s.log.last_us - s.log.first_us) * 1e-6},
          {"damaged_bytes", s.log.skipped_bytes},
          {"left_out_events", s.executor.left_out()},
          {"clock_jumps", s.executor.clock_jumps()}};
}

/// By node and cause.
Json drops_of(const Summary& s) {
  Json drops = Json::object();
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    health_t health{};
    s.nodes[i]->report(health);
    add_drops(health, s.executor.counts(i));
    Json causes = Json::object();
    for (const drop_t& drop : health.drops) causes[drop.cause] = drop.count;
    drops[s.nodes[i]->name()] = causes;
  }
  return drops;
}

Json timing_of(const Summary& s) {
  Json timing;
  timing["seconds"] = milliseconds(s.took) * 1e-3;
  timing["threads"] = s.request.threads;
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const NodeTiming& node = s.executor.timing(i);
    timing[s.nodes[i]->name()] = {
        {"accept_ms", milliseconds(node.accept)},  {"step_ms", milliseconds(node.step)},
        {"tick_ms", milliseconds(node.tick)},      {"median_ms", node.runs.percentile_ms(0.5)},
        {"p99_ms", node.runs.percentile_ms(0.99)}, {"max_ms", node.runs.max_ms()}};
  }
  return timing;
}

}  // namespace

MapArea area_of(const MapRaster& map) {
  const double cell_m2 = map.cells.resolution_m * map.cells.resolution_m;
  MapArea area;
  for (const VertexState state : map.state) {
    if (state == VertexState::kFree) area.free_m2 += cell_m2;
    if (state == VertexState::kBlocked) area.blocked_m2 += cell_m2;
  }
  return area;
}

std::string path_status_name(std::int8_t status) {
  constexpr std::array kNames{"idle",          "following",    "reached",   "frontier",   "no path",
                              "start blocked", "goal blocked", "stale map", "stale pose", "cancelled"};
  const auto index = static_cast<std::size_t>(status);
  return index < kNames.size() ? kNames[index] : "unknown";
}

void write_summary(const Summary& s, const std::filesystem::path& file) {
  Json json;
  json["frames"] = s.totals.frames;
  json["points"] = s.totals.points;
  json["sections"] = {{"processed", s.totals.sections_processed}, {"skipped", s.totals.sections_skipped}};
  json["surfels"] = s.totals.surfels;
  json["frames_with_floor"] = s.totals.frames_with_floor;
  json["map"] = map_of(s);
  json["path"] = path_of(s);
  json["log"] = log_of(s);
  json["interrupted"] = s.interrupted;
  json["published"] = s.observer.published();
  json["drops"] = drops_of(s);
  json["config_hash"] = settings_hash(s.request.settings);
  json["timing"] = timing_of(s);
  TextFile text(file);
  text.write(json.dump(2) + "\n");
  text.close();
}

}  // namespace floornav
