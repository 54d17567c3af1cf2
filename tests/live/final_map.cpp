// final-map LOG: puts the GRID_MAP messages of a log together and prints the vertices that were seen: "ix iy
// state".

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>

#include "floornav/grid_map_t.hpp"
#include "lcmtypes/channels.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "runtime/process/log_reader.hpp"

namespace {

using namespace floornav;

GridMapReceiver read_map(const char* log) {
  GridMapReceiver receiver;
  LogReader reader(log);
  LogEvent event;
  while (reader.next(event)) {
    if (event.channel != channel::kGridMap) continue;
    grid_map_t message;
    const int size = static_cast<int>(event.bytes.size());
    if (message.decode(event.bytes.data(), 0, size) != size)
      throw LogError("a GRID_MAP that does not decode");
    receiver.apply(message);
  }
  return receiver;
}

void print(const GridMap& map) {
  std::map<CellIndex, VertexState> seen;
  for (const auto& [tile, vertices] : map.tiles())
    for (std::int32_t k = 0; k < GridTile::kVertices; ++k)
      if (vertices->state[static_cast<std::size_t>(k)] != VertexState::kUnknown)
        seen[{tile.ix * GridTile::kSide + k % GridTile::kSide,
              tile.iy * GridTile::kSide + k / GridTile::kSide}] =
            vertices->state[static_cast<std::size_t>(k)];
  for (const auto& [vertex, state] : seen)
    std::printf("%d %d %s\n", vertex.ix, vertex.iy, state == VertexState::kFree ? "free" : "blocked");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: final-map LOG\n");
    return 2;
  }
  try {
    print(read_map(argv[1]).map());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "final-map: %s\n", error.what());
    return 1;
  }
}
