// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/frame_renderer.h"

#include "pcl_sq/exception.h"
#include "visualization/display/gl_display.h"
#include "visualization/drawing/actors.h"
#include "visualization/drawing/overlay.h"
#include "visualization/files/vtk_bytes.h"

#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <mutex>

namespace pcl_sq {
namespace {

/// Pixels up to which a picture is rendered twice as large and averaged; beyond, they
/// are fine enough, and layers of translucent bodies would take gigabytes.
constexpr long LARGEST_SMOOTHED = 2560L * 1920L;

/** \brief VTK's factories and X's error handler belong to the whole process. */
std::mutex& renderMutex() {
  static std::mutex mutex;
  return mutex;
}

/** \brief Libraries print nothing: VTK's messages are off while it works for us. */
class QuietVtk {
public:
  QuietVtk() : before_(vtkObject::GetGlobalWarningDisplay()) {
    vtkObject::GlobalWarningDisplayOff();
  }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

private:
  int before_;
};

/** \brief Mean of zoom x zoom pixels, rows turned top down. */
SnapshotImage
reduce(const vtkUnsignedCharArray& pixels, int width, int height, int zoom) {
  SnapshotImage image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * height);
  const unsigned char* from = const_cast<vtkUnsignedCharArray&>(pixels).GetPointer(0);
  const std::size_t row = 3 * static_cast<std::size_t>(width) * zoom;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int dy = 0; dy < zoom; ++dy)
          for (int dx = 0; dx < zoom; ++dx)
            sum += from[row * std::size_t((height - 1 - y) * zoom + dy) +
                        std::size_t(3) * (x * zoom + dx) + c];
        image.rgb[3 * (static_cast<std::size_t>(y) * width + x) + c] =
            static_cast<std::uint8_t>((sum + zoom * zoom / 2) / (zoom * zoom));
      }
  return image;
}

class VtkRenderer : public FrameRenderer {
public:
  VtkRenderer(int width, int height);
  SnapshotImage render(const SnapshotScene& scene,
                       const Eigen::Matrix3Xd& focus,
                       const ViewCamera& camera) override;

private:
  // in this order: the window is gone before its display
  std::unique_lock<std::mutex> lock_{renderMutex()};
  QuietVtk quiet_;
  GlDisplay display_;
  vtkNew<vtkRenderWindow> window_;
  int zoom_ = 2;
};

VtkRenderer::VtkRenderer(int width, int height) {
  if (static_cast<long>(width) * height > LARGEST_SMOOTHED)
    zoom_ = 1;
  window_->SetDisplayId(display_.connection());
  window_->SetOffScreenRendering(1);
  window_->SetSize(zoom_ * width, zoom_ * height);
  window_->SetMultiSamples(0); // depth peeling has no samples; we average instead
  window_->SetAlphaBitPlanes(1);
}

SnapshotImage VtkRenderer::render(const SnapshotScene& scene,
                                  const Eigen::Matrix3Xd& focus,
                                  const ViewCamera& camera) {
  vtkNew<vtkRenderer> renderer;
  window_->AddRenderer(renderer);
  const Color paper = scene.options.background;
  renderer->SetBackground(paper.r / 255.0, paper.g / 255.0, paper.b / 255.0);
  // translucent bodies in their order of depth, whatever their order of drawing; a
  // single superquadric shows one layer and is spared the work
  const bool layers = scene.model.size() > 1 || !scene.surfaces.empty();
  renderer->SetUseDepthPeeling(layers ? 1 : 0);
  renderer->SetMaximumNumberOfPeels(8);
  renderer->SetOcclusionRatio(0.0);

  Stage(renderer, camera, focus, zoom_).add(scene);
  Overlay overlay(renderer, camera.width(), camera.height(), zoom_);
  drawDecorations(overlay, OverlayLayout(scene), scene, camera);

  window_->Render();
  const int width = zoom_ * camera.width(), height = zoom_ * camera.height();
  vtkNew<vtkUnsignedCharArray> pixels;
  const bool read =
      window_->GetPixelData(0, 0, width - 1, height - 1, 0, pixels) != 0 &&
      pixels->GetNumberOfValues() == 3LL * width * height;
  window_->RemoveRenderer(renderer);
  if (!read)
    throw Exception(
        "[pcl_sq::SnapshotRenderer::render] the display gives no picture of "
        "that size; ask for a smaller one.");
  return reduce(*pixels, camera.width(), camera.height(), zoom_);
}

} // namespace
} // namespace pcl_sq

const pcl_sq::VtkPart* pcl_sq_vtk_part() {
  using namespace pcl_sq;
  static const VtkPart PART{
      [](int width, int height) -> std::unique_ptr<FrameRenderer> {
        return std::make_unique<VtkRenderer>(width, height);
      },
      pngBytes,
      vtpBytes};
  return &PART;
}
