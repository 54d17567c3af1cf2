#include "mapping/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace floornav {
namespace {

/// The free vertices' rectangle with one ring around it.
struct Field {
  CellIndex first;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<bool> free;
  std::vector<std::int32_t> nearest;  ///< the cell that is not free and nearest; itself where not free
  std::vector<float> distance;        ///< to it, in cells

  [[nodiscard]] std::size_t size() const { return free.size(); }
  [[nodiscard]] std::int32_t beside(std::int32_t cell, std::size_t k) const {
    return cell + kNeighbourY[k] * width + kNeighbourX[k];
  }
  [[nodiscard]] float between(std::int32_t a, std::int32_t b) const {
    const auto dx = static_cast<float>(a % width - b % width);
    return std::hypot(dx, static_cast<float>(a / width - b / width));
  }
  [[nodiscard]] bool is_free(std::int32_t cell) const { return free[static_cast<std::size_t>(cell)]; }
};

Field field_of(const GridMap& map) {
  Field field;
  CellIndex last{-1, -1};
  const std::vector<CellIndex> tiles = map.sorted_tiles();
  if (tiles.empty()) return field;
  field.first = last = tiles.front();
  for (const CellIndex tile : tiles) {
    field.first = {std::min(field.first.ix, tile.ix), std::min(field.first.iy, tile.iy)};
    last = {std::max(last.ix, tile.ix), std::max(last.iy, tile.iy)};
  }
  field.width = (last.ix - field.first.ix + 1) * GridTile::kSide + 2;
  field.height = (last.iy - field.first.iy + 1) * GridTile::kSide + 2;
  field.first = {field.first.ix * GridTile::kSide - 1, field.first.iy * GridTile::kSide - 1};
  field.free.resize(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height));
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto cell = static_cast<std::int32_t>(i);
    field.free[i] = map.state({field.first.ix + cell % field.width, field.first.iy + cell / field.width}) ==
                    VertexState::kFree;
  }
  return field;
}

/// Brushfire: every free cell learns its nearest other cell from its neighbours.
void find_nearest(Field& field) {
  using Entry = std::tuple<float, std::int32_t, std::int32_t>;  // distance, cell, nearest
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  field.nearest.assign(field.size(), -1);
  field.distance.assign(field.size(), 0);
  for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(field.size()); ++cell)
    if (!field.is_free(cell)) front.emplace(0.0F, cell, cell);
  while (!front.empty()) {
    const auto [distance, cell, nearest] = front.top();
    front.pop();
    const auto i = static_cast<std::size_t>(cell);
    if (field.nearest[i] >= 0) continue;
    field.nearest[i] = nearest;
    field.distance[i] = distance;
    for (std::size_t k = 0; k < 8; ++k) {
      if (!field.is_free(cell) &&
          (cell % field.width + kNeighbourX[k] < 0 || cell % field.width + kNeighbourX[k] >= field.width ||
           cell / field.width + kNeighbourY[k] < 0 || cell / field.width + kNeighbourY[k] >= field.height))
        continue;
      const std::int32_t next = field.beside(cell, k);
      if (field.nearest[static_cast<std::size_t>(next)] < 0)
        front.emplace(field.between(next, nearest), next, nearest);
    }
  }
}

/// A cell on the border of two Voronoi cells whose sites lie apart.
bool on_ridge(const Field& field, std::int32_t cell) {
  const auto i = static_cast<std::size_t>(cell);
  for (std::size_t k = 0; k < 8; k += 2) {
    const auto other = static_cast<std::size_t>(field.beside(cell, k));
    if (field.free[other] && field.between(field.nearest[i], field.nearest[other]) > field.distance[i])
      return true;
  }
  return false;
}

/// Lines one cell wide: cells are taken away from the sides where that joins and parts nothing.
class Thinner {
 public:
  Thinner(const Field& field, float least_distance) : field_(field), line_(field.size()) {
    for (std::size_t i = 0; i < field.size(); ++i)
      line_[i] = field.free[i] && field.distance[i] >= least_distance;
  }

  std::vector<bool> thin() {
    std::vector<std::int32_t> order;
    for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(line_.size()); ++cell)
      if (on(cell)) order.push_back(cell);
    std::ranges::stable_sort(
        order, {}, [&](std::int32_t cell) { return field_.distance[static_cast<std::size_t>(cell)]; });
    remove(order, [&](std::int32_t cell) { return on_ridge(field_, cell); });
    remove(order, [&](std::int32_t cell) { return neighbours(cell) < 2; });
    return line_;
  }

 private:
  template <class Keep>
  void remove(const std::vector<std::int32_t>& order, Keep keep) {
    for (bool changed = true; changed;) {
      changed = false;
      for (const std::int32_t cell : order) {
        if (!on(cell) || keep(cell) || !is_simple(cell)) continue;
        line_[static_cast<std::size_t>(cell)] = false;
        changed = true;
      }
    }
  }
  [[nodiscard]] bool on(std::int32_t cell) const { return line_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] int neighbours(std::int32_t cell) const {
    int sum = 0;
    for (std::size_t k = 0; k < 8; ++k) sum += on(field_.beside(cell, k)) ? 1 : 0;
    return sum;
  }
  /// Whether the cells around stay joined without it, and no hole opens: one run of line cells around it, and
  /// one of others that touches a side.
  [[nodiscard]] bool is_simple(std::int32_t cell) const {
    int crossings = 0;
    for (std::size_t k = 0; k < 8; k += 2) {
      const bool here = on(field_.beside(cell, k));
      const bool corner = on(field_.beside(cell, k + 1));
      const bool next = on(field_.beside(cell, (k + 2) & 7U));
      crossings += !here && (corner || next) ? 1 : 0;
    }
    return crossings == 1;
  }

  const Field& field_;
  std::vector<bool> line_;
};

/// Follows the lines from node to node.
class LineTracer {
 public:
  LineTracer(const Field& field, std::vector<bool> line, const Lattice& lattice)
      : field_(field),
        line_(std::move(line)),
        lattice_(lattice),
        node_of_(field.size(), -1),
        done_(field.size()) {}

  Roadmap trace() {
    for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(line_.size()); ++cell)
      if (line_[static_cast<std::size_t>(cell)] && around(cell).size() != 2) add_node(cell);
    const std::vector<std::int32_t> ends = nodes_;
    for (const std::int32_t node : ends)
      for (const std::int32_t next : around(node)) follow(node, next);
    for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(line_.size()); ++cell) {
      const auto i = static_cast<std::size_t>(cell);
      if (!line_[i] || done_[i] || node_of_[i] >= 0) continue;  // a ring without a node
      add_node(cell);
      follow(cell, around(cell).front());
    }
    return std::move(roadmap_);
  }

 private:
  /// Cells of the line around one; a corner that a side already leads to is no way of its own.
  [[nodiscard]] std::vector<std::int32_t> around(std::int32_t cell) const {
    std::vector<std::int32_t> found;
    const auto on = [&](std::size_t k) {
      return line_[static_cast<std::size_t>(field_.beside(cell, k & 7U))];
    };
    for (std::size_t k = 0; k < 8; ++k)
      if (on(k) && (k % 2 == 0 || (!on(k + 7) && !on(k + 1)))) found.push_back(field_.beside(cell, k));
    return found;
  }
  [[nodiscard]] Eigen::Vector2d place_m(std::int32_t cell) const {
    const double x_m = lattice_.center_of(field_.first.ix + cell % field_.width);
    return {x_m, lattice_.center_of(field_.first.iy + cell / field_.width)};
  }
  [[nodiscard]] double clearance_m(std::int32_t cell) const {
    return static_cast<double>(field_.distance[static_cast<std::size_t>(cell)]) * lattice_.pitch_m;
  }
  void add_node(std::int32_t cell) {
    node_of_[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(cell);
    roadmap_.nodes.push_back({place_m(cell), clearance_m(cell)});
  }

  void follow(std::int32_t node, std::int32_t next) {
    Roadmap::Way way;
    way.from = node_of_[static_cast<std::size_t>(node)];
    way.clearance_m = clearance_m(node);
    way.places_m = {place_m(node)};
    std::int32_t before = node;
    for (;;) {
      const auto i = static_cast<std::size_t>(next);
      way.length_m += (place_m(next) - way.places_m.back()).norm();
      way.places_m.push_back(place_m(next));
      way.clearance_m = std::min(way.clearance_m, clearance_m(next));
      if (node_of_[i] >= 0) break;
      if (done_[i]) return;  // followed from its other end
      done_[i] = true;
      const std::vector<std::int32_t> on = around(next);
      const std::int32_t after = on.front() == before ? on.back() : on.front();
      before = next;
      next = after;
    }
    way.to = node_of_[static_cast<std::size_t>(next)];
    if (way.places_m.size() == 2 && way.to < way.from) return;  // two nodes side by side: once is enough
    roadmap_.ways.push_back(std::move(way));
  }

  const Field& field_;
  std::vector<bool> line_;
  Lattice lattice_;
  std::vector<std::int32_t> node_of_;
  std::vector<bool> done_;
  std::vector<std::int32_t> nodes_;
  Roadmap roadmap_;
};

/// A way to a dead end that leads nowhere but closer to a corner.
void prune(Roadmap& roadmap) {
  std::vector<int> degree(roadmap.nodes.size(), 0);
  for (const Roadmap::Way& way : roadmap.ways)
    for (const std::int32_t end : {way.from, way.to}) ++degree[static_cast<std::size_t>(end)];
  std::erase_if(roadmap.ways, [&](const Roadmap::Way& way) {
    const auto from = static_cast<std::size_t>(way.from);
    const auto to = static_cast<std::size_t>(way.to);
    if ((degree[from] == 1) == (degree[to] == 1)) return false;
    return way.length_m < roadmap.nodes[degree[from] == 1 ? to : from].clearance_m;
  });
}

/// Leaves out nodes that no way leads to.
void drop_lone_nodes(Roadmap& roadmap) {
  std::vector<std::int32_t> number(roadmap.nodes.size(), -1);
  std::vector<Roadmap::Node> kept;
  for (Roadmap::Way& way : roadmap.ways) {
    for (std::int32_t* const end : {&way.from, &way.to}) {
      const auto before = static_cast<std::size_t>(*end);
      if (number[before] < 0) {
        number[before] = static_cast<std::int32_t>(kept.size());
        kept.push_back(roadmap.nodes[before]);
      }
      *end = number[before];
    }
  }
  roadmap.nodes = std::move(kept);
}

}  // namespace

Roadmap make_roadmap(const GridMap& map, double least_clearance_m) {
  Field field = field_of(map);
  if (field.size() == 0) return {};
  find_nearest(field);
  const auto least = static_cast<float>(least_clearance_m / map.lattice().pitch_m);
  Roadmap roadmap = LineTracer(field, Thinner(field, std::max(1.0F, least)).thin(), map.lattice()).trace();
  prune(roadmap);
  drop_lone_nodes(roadmap);
  return roadmap;
}

}  // namespace floornav
