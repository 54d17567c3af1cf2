#include "tools/bench/boost_peer.hpp"

#include <limits>
#include <utility>
#include <vector>

#include <boost/graph/astar_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

struct StepWeight {
  std::uint32_t cost = 0;
};
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, StepWeight,
                                                 boost::no_property, std::uint32_t, std::uint32_t>;
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

class Octile : public boost::astar_heuristic<Graph, std::uint32_t> {
 public:
  Octile(const std::vector<GridCell>& cells, GridCell goal, StepCosts steps)
      : cells_(&cells), goal_(goal), steps_(steps) {}
  std::uint32_t operator()(std::uint32_t vertex) const {
    return octile(goal_.x - (*cells_)[vertex].x, goal_.y - (*cells_)[vertex].y, steps_);
  }

 private:
  const std::vector<GridCell>* cells_;
  GridCell goal_;
  StepCosts steps_;
};

struct GoalReached {};

class StopAtGoal : public boost::default_astar_visitor {
 public:
  explicit StopAtGoal(std::uint32_t goal) : goal_(goal) {}
  void examine_vertex(std::uint32_t vertex, const Graph&) const {
    if (vertex == goal_) throw GoalReached{};
  }

 private:
  std::uint32_t goal_;
};

}  // namespace

struct BoostPeer::State {
  SearchGrid grid;
  std::vector<std::uint32_t> vertex_of;  ///< a cell
  std::vector<GridCell> cells;           ///< of the vertices
  Graph graph;
  std::vector<std::uint32_t> parent, distance, rank;
  std::vector<boost::default_color_type> color;
};

BoostPeer::BoostPeer(const SearchGrid& grid) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.grid = grid;
  s.vertex_of.assign(grid.edges.size(), kNoVertex);
  for (std::int32_t y = 0; y < grid.height; ++y)
    for (std::int32_t x = 0; x < grid.width; ++x)
      if (grid.edges[grid.index({x, y})] != 0) {
        s.vertex_of[grid.index({x, y})] = static_cast<std::uint32_t>(s.cells.size());
        s.cells.push_back({x, y});
      }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<StepWeight> weights;
  for (std::size_t v = 0; v < s.cells.size(); ++v) {
    const GridCell cell = s.cells[v];
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid.edges[grid.index(cell)] >> k & 1) == 0) continue;
      edges.emplace_back(static_cast<std::uint32_t>(v),
                         s.vertex_of[grid.index({cell.x + kStepX[k], cell.y + kStepY[k]})]);
      weights.push_back({k % 2 == 1 ? grid.steps.diagonal : grid.steps.straight});
    }
  }
  s.graph = Graph(boost::edges_are_sorted, edges.begin(), edges.end(), weights.begin(),
                  static_cast<std::uint32_t>(s.cells.size()));
  s.parent.resize(s.cells.size());
  s.distance.resize(s.cells.size());
  s.rank.resize(s.cells.size());
  s.color.resize(s.cells.size());
}

BoostPeer::~BoostPeer() = default;

std::optional<std::uint32_t> BoostPeer::search(GridCell start, GridCell goal) {
  State& s = *state_;
  const std::uint32_t from = s.vertex_of[s.grid.index(start)], to = s.vertex_of[s.grid.index(goal)];
  if (from == kNoVertex || to == kNoVertex) return std::nullopt;
  try {
    boost::astar_search(s.graph, from, Octile(s.cells, goal, s.grid.steps),
                        boost::visitor(StopAtGoal(to))
                            .weight_map(boost::get(&StepWeight::cost, s.graph))
                            .predecessor_map(s.parent.data())
                            .distance_map(s.distance.data())
                            .rank_map(s.rank.data())
                            .color_map(s.color.data())
                            .distance_inf(kNoVertex));
  } catch (const GoalReached&) {
    return s.distance[to];
  }
  return std::nullopt;
}

}  // namespace floornav
