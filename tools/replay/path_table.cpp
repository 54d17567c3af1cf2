#include "tools/replay/path_table.hpp"

#include <fmt/format.h>

#include "tools/replay/text_file.hpp"

namespace floornav {

void write_path_table(const std::optional<path_t>& path, const std::filesystem::path& file) {
  TextFile table(file);
  table.write("x,y,z,heading,speed\n");
  if (path)
    for (const path_point_t& p : path->points)
      table.write(fmt::format("{:.4f},{:.4f},{:.4f},{:.5f},{:.4f}\n", p.x, p.y, p.z, p.heading, p.speed));
  table.close();
}

}  // namespace floornav
