#pragma once

namespace floornav {

/// What this process holds now: what must not grow with the number of reconnects.
struct ProcessResources {
  long resident_kb = 0;
  int threads = 0;
  int descriptors = 0;

  static ProcessResources now();
  /// Waits for up to 5 s until the threads and descriptors are no more than `before`'s: some end a moment
  /// later.
  static ProcessResources settled(const ProcessResources& before);
};

/// The larger of the two, of each kind.
ProcessResources most_of(const ProcessResources& a, const ProcessResources& b);

}  // namespace floornav
