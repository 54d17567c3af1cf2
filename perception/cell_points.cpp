#include "perception/cell_points.hpp"

#include <algorithm>
#include <utility>

namespace floornav {

namespace {

constexpr std::int32_t kPointsPerPiece = 16384;
constexpr std::size_t kShares = 4;       ///< whatever the number of workers
constexpr std::int32_t kNotWanted = -1;  ///< instead of a place

}  // namespace

void CellSorter::place(const RoiCloud& cloud, std::span<const std::int16_t> label,
                       std::span<const SectionResult> sections, int first, int end, const SensorView& view,
                       const CellWindow& window, Parallel& parallel) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  planes_.clear();
  for (const SectionResult& result : sections.first(static_cast<std::size_t>(end)))
    for (const SectionPlane& found : result.planes) planes_.add(found.plane, R);
  planes_.add({0.0F, 0.0F, 1.0F}, R);  // what points without a plane look at, to no effect
  cut_pieces(cloud, first, end);
  const auto place_piece = [&](int number, int) {
    const Piece& piece = pieces_[static_cast<std::size_t>(number)];
    const SectionResult& result = sections[static_cast<std::size_t>(piece.section)];
    if (result.done) {
      place_points(cloud, label, piece.begin, piece.end, planes_, result.first_surfel, roughness_m_, view,
                   window, placed_);
    } else {
      std::fill(placed_.cell.begin() + piece.begin, placed_.cell.begin() + piece.end, -1);
    }
  };
  parallel.run(static_cast<int>(pieces_.size()), std::ref(place_piece));
}

void CellSorter::cut_pieces(const RoiCloud& cloud, int first, int end) {
  pieces_.clear();
  for (int section = first; section < end; ++section) {
    const std::int32_t section_end = cloud.section_end[static_cast<std::size_t>(section)];
    for (std::int32_t p = cloud.section_begin(section); p < section_end; p += kPointsPerPiece)
      pieces_.push_back({section, p, std::min(p + kPointsPerPiece, section_end)});
  }
}

void CellSorter::sort(const RoiCloud& cloud, std::span<const std::int16_t> label,
                      std::span<const SectionResult> sections, int end, const CellSections& cells,
                      bool is_near, Parallel& parallel, CellPoints& out) {
  const std::int64_t points = cloud.section_end[static_cast<std::size_t>(end) - 1];
  const auto bound = [points](std::int64_t share) {
    return static_cast<std::int32_t>(points * share / static_cast<std::int64_t>(kShares));
  };
  shares_.resize(kShares);
  const auto count = [&](int number, int) {
    Share& share = shares_[static_cast<std::size_t>(number)];
    share.begin = bound(number);
    share.end = bound(number + 1);
    count_points(share, cells.size());
  };
  parallel.run(static_cast<int>(kShares), std::ref(count));
  lay_out(cells, is_near, out);
  const auto fill = [&](int number, int) {
    fill_in(shares_[static_cast<std::size_t>(number)], cloud, label,
            sections.first(static_cast<std::size_t>(end)), out);
  };
  parallel.run(static_cast<int>(kShares), std::ref(fill));
}

void CellSorter::count_points(Share& share, std::size_t cells) const {
  share.next.assign(1 + cells, 0);
  for (std::int32_t p = share.begin; p < share.end; ++p)
    ++share.next[static_cast<std::size_t>(1 + placed_.cell[static_cast<std::size_t>(p)])];
}

/// Turns the numbers of points into places.
void CellSorter::lay_out(const CellSections& cells, bool is_near, CellPoints& out) {
  for (Share& share : shares_) share.next.front() = kNotWanted;
  out.cell_end.resize(cells.size());
  std::int32_t place = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const bool is_wanted = cells.is_near(static_cast<std::int32_t>(c)) == is_near;
    for (Share& share : shares_) {
      std::int32_t& next = share.next[1 + c];
      if (is_wanted) {
        place += std::exchange(next, place);
      } else {
        next = kNotWanted;
      }
    }
    out.cell_end[c] = place;
  }
  out.points.resize(static_cast<std::size_t>(place));
}

void CellSorter::fill_in(Share& share, const RoiCloud& cloud, std::span<const std::int16_t> label,
                         std::span<const SectionResult> sections, CellPoints& out) const {
  for (std::size_t section = 0; section < sections.size(); ++section) {
    const std::int32_t last = std::min(share.end, cloud.section_end[section]);
    const int first_surfel = sections[section].first_surfel;
    for (std::int32_t p = std::max(share.begin, cloud.section_begin(static_cast<int>(section))); p < last;
         ++p) {
      const auto i = static_cast<std::size_t>(p);
      std::int32_t& next = share.next[static_cast<std::size_t>(1 + placed_.cell[i])];
      if (next == kNotWanted) continue;
      const int surfel = label[i] >= 0 ? first_surfel + label[i] : -1;
      out.points[static_cast<std::size_t>(next++)] = {static_cast<std::int16_t>(surfel), placed_.z_m[i],
                                                      placed_.rise_m[i], placed_.var_m2[i],
                                                      placed_.common_m2[i]};
    }
  }
}

}  // namespace floornav
