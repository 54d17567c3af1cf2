#include "perception/thinned_frame.hpp"

namespace floornav {

namespace {

template <class T>
void take_each(std::span<const T> from, const Pinhole& camera, int first, int stride, std::vector<T>& to) {
  to.clear();
  if (from.empty()) return;
  for (int row = first; row < camera.height; row += stride)
    for (int column = first; column < camera.width; column += stride)
      to.push_back(from[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width) +
                        static_cast<std::size_t>(column)]);
}

}  // namespace

DepthFrame ThinnedFrame::thin(const DepthFrame& frame, int stride) {
  const Pinhole& camera = frame.camera;
  if (stride <= 1 || camera.width < stride || camera.height < stride) return frame;
  const int first = (stride - 1) / 2;
  const auto n = static_cast<float>(stride);
  const auto shift = static_cast<float>(first);
  DepthFrame thinned = frame;
  thinned.camera = {camera.fx / n,
                    camera.fy / n,
                    (camera.cx - shift) / n,
                    (camera.cy - shift) / n,
                    (camera.width - first + stride - 1) / stride,
                    (camera.height - first + stride - 1) / stride};
  // A pixel is n times as wide: the same disparity counts for fewer of them.
  thinned.disparity_sigma_px = frame.disparity_sigma_px / n;
  thinned.uncertainty_scale = frame.uncertainty_scale / n;
  if (frame.meaning == PixelMeaning::kDisparity) thinned.scale = frame.scale / n;
  take_each(frame.pixels, camera, first, stride, pixels_);
  take_each(frame.uncertainty, camera, first, stride, uncertainty_);
  thinned.pixels = pixels_;
  thinned.uncertainty = uncertainty_;
  return thinned;
}

}  // namespace floornav
