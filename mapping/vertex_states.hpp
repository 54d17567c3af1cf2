#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace floornav {

enum class VertexState : std::uint8_t { kUnknown = 0, kFree = 1, kBlocked = 2 };

/// The states of a tile's vertices in 2 bits each, used like an array; all unknown at first.
template <std::size_t kVertices>
class VertexStates {
 public:
  class Reference {
   public:
    Reference(VertexStates& states, std::size_t vertex) : states_(states), vertex_(vertex) {}
    Reference& operator=(VertexState state) {
      states_.set(vertex_, state);
      return *this;
    }
    operator VertexState() const { return states_.get(vertex_); }  // NOLINT(google-explicit-constructor)

   private:
    VertexStates& states_;
    std::size_t vertex_;
  };

  [[nodiscard]] static constexpr std::size_t size() { return kVertices; }
  VertexState operator[](std::size_t vertex) const { return get(vertex); }
  Reference operator[](std::size_t vertex) { return {*this, vertex}; }
  [[nodiscard]] std::size_t count(VertexState state) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < kVertices; ++i) count += get(i) == state ? 1 : 0;
    return count;
  }
  friend bool operator==(const VertexStates&, const VertexStates&) = default;

 private:
  [[nodiscard]] VertexState get(std::size_t vertex) const {
    return static_cast<VertexState>((bytes_[vertex / 4] >> (2 * (vertex % 4))) & 3U);
  }
  void set(std::size_t vertex, VertexState state) {
    const auto shift = static_cast<unsigned>(2 * (vertex % 4));
    const unsigned others = bytes_[vertex / 4] & ~(3U << shift);
    bytes_[vertex / 4] = static_cast<std::uint8_t>(others | (static_cast<unsigned>(state) << shift));
  }

  std::array<std::uint8_t, (kVertices + 3) / 4> bytes_{};
};

}  // namespace floornav
