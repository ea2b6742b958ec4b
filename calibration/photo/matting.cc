// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/matting.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kRegularity = 1e-6f;  // of a window's colours, squares of linear light
constexpr int kSmallest = 32;          // [px], of the coarsest level
constexpr int kMostSteps = 400;        // of conjugate gradients, a level
constexpr double kPrecise = 3e-6;      // of the residual, beside the diagonal
constexpr float kCertain = 0.02f;      // shares so near to 0 or 1 are that

bool IsOpen(float drawn) { return drawn > 0 && drawn < 1; }

// 3 x 3 pixels, and how colours make shares in them.
struct Window {
  size_t center;
  Vector3d mean;
  Eigen::Matrix3d inverse;  // of the covariance, which is nearly singular: a window has few colours
};

// The matting Laplacian of the windows that hold a pixel which is to be found, never written out.
class Laplacian {
 public:
  Laplacian(const Raster& photo, const Raster& drawn) : photo_(photo) {
    for (int y = 1; y + 1 < photo.height; ++y) {
      for (int x = 1; x + 1 < photo.width; ++x) {
        if (HoldsOpen(drawn, x, y)) windows_.push_back(WindowAt(x, y));
      }
    }
  }

  std::vector<float> Times(const std::vector<float>& share) const {
    std::vector<float> product(share.size(), 0);
    for (const Window& window : windows_) {
      double sum = 0;
      Vector3d weighted = Vector3d::Zero();
      ForEach(window, [&](size_t i, const Vector3d& off) {
        sum += share[i];
        weighted += share[i] * off;
      });
      const Vector3d slope = window.inverse * weighted;
      ForEach(window, [&](size_t i, const Vector3d& off) {
        product[i] += share[i] - static_cast<float>((sum + off.dot(slope)) / 9);
      });
    }
    return product;
  }

  std::vector<float> Diagonal() const {
    std::vector<float> diagonal(photo_.data.size() / 3, 0);
    for (const Window& window : windows_) {
      ForEach(window, [&](size_t i, const Vector3d& off) {
        diagonal[i] += 1 - static_cast<float>((1 + off.dot(window.inverse * off)) / 9);
      });
    }
    return diagonal;
  }

 private:
  static bool HoldsOpen(const Raster& drawn, int x, int y) {
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) {
        if (IsOpen(*drawn.At(u, v))) return true;
      }
    }
    return false;
  }

  Vector3d Color(size_t i) const {
    return Eigen::Map<const Eigen::Vector3f>(&photo_.data[3 * i]).cast<double>();
  }

  template <typename Function>
  void ForEach(const Window& window, const Function& function) const {
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) {
        const size_t i = window.center + static_cast<std::ptrdiff_t>(v) * photo_.width + u;
        function(i, Color(i) - window.mean);
      }
    }
  }

  Window WindowAt(int x, int y) const {
    Window window{static_cast<size_t>(y) * photo_.width + x, Vector3d::Zero(), {}};
    Vector3d mean = Vector3d::Zero();
    ForEach(window, [&](size_t, const Vector3d& color) { mean += color / 9; });
    window.mean = mean;
    Eigen::Matrix3d covariance = kRegularity / 9 * Eigen::Matrix3d::Identity();
    ForEach(window, [&](size_t, const Vector3d& off) { covariance += off * off.transpose() / 9; });
    window.inverse = covariance.inverse();
    return window;
  }

  const Raster& photo_;
  std::vector<Window> windows_;
};

double Dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

// a + factor * b
std::vector<float> Sum(const std::vector<float>& a, double factor, const std::vector<float>& b) {
  std::vector<float> sum(a.size());
  for (size_t i = 0; i < a.size(); ++i) sum[i] = a[i] + static_cast<float>(factor) * b[i];
  return sum;
}

// What the drawing says stays; `share` holds the start.
void Solve(const Raster& photo, const Raster& drawn, Raster* share) {
  const Laplacian laplacian(photo, drawn);
  const std::vector<float> diagonal = laplacian.Diagonal();
  std::vector<float> inverse(diagonal.size(), 0);  // and zero where nothing is to be found
  for (size_t i = 0; i < inverse.size(); ++i) {
    if (IsOpen(drawn.data[i]) && diagonal[i] > 0) inverse[i] = 1 / diagonal[i];
  }
  const auto preconditioned = [&](const std::vector<float>& residual) {
    std::vector<float> result(residual.size());
    for (size_t i = 0; i < result.size(); ++i) result[i] = inverse[i] * residual[i];
    return result;
  };
  std::vector<float>& x = share->data;
  std::vector<float> r = laplacian.Times(x);
  for (size_t i = 0; i < r.size(); ++i) r[i] = IsOpen(drawn.data[i]) ? -r[i] : 0;
  std::vector<float> z = preconditioned(r), p = z;
  double rz = Dot(r, z);
  const double enough = kPrecise * kPrecise * Dot(diagonal, diagonal);
  for (int step = 0; step < kMostSteps && rz > 0 && Dot(r, r) > enough; ++step) {
    std::vector<float> product = laplacian.Times(p);
    for (size_t i = 0; i < product.size(); ++i) {
      if (!IsOpen(drawn.data[i])) product[i] = 0;
    }
    const double curvature = Dot(p, product);
    if (curvature <= 0) return;
    x = Sum(x, rz / curvature, p);
    r = Sum(r, -rz / curvature, product);
    z = preconditioned(r);
    const double next = Dot(r, z);
    p = Sum(z, next / rz, p);
    rz = next;
  }
}

// Means of 2 x 2 pixels; of a drawing where they agree, else to be found.
Raster Halved(const Raster& fine, bool is_drawing) {
  Raster half((fine.width + 1) / 2, (fine.height + 1) / 2, fine.channels);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int i = 0; i < 4; ++i) {
        const float* from = fine.At(std::min(2 * x + i % 2, fine.width - 1),
                                    std::min(2 * y + i / 2, fine.height - 1));
        for (int c = 0; c < fine.channels; ++c) half.At(x, y)[c] += from[c] / 4;
      }
      if (is_drawing && IsOpen(*half.At(x, y))) *half.At(x, y) = 0.5f;
    }
  }
  return half;
}

Raster Matte(const Raster& photo, const Raster& drawn) {
  Raster share = drawn;
  if (std::min(photo.width, photo.height) > kSmallest) {
    const Raster coarse = Matte(Halved(photo, false), Halved(drawn, true));
    for (int y = 0; y < share.height; ++y) {
      for (int x = 0; x < share.width; ++x) {
        if (IsOpen(*drawn.At(x, y))) *share.At(x, y) = *coarse.At(x / 2, y / 2);
      }
    }
  }
  Solve(photo, drawn, &share);
  return share;
}

}  // namespace

Raster EstimateMatte(const Raster& photo, Raster trimap) {
  INSITU_CHECK(trimap.channels == 1 && photo.channels == 3);
  INSITU_CHECK(trimap.width == photo.width && trimap.height == photo.height);
  for (float& drawn : trimap.data) {
    if (IsOpen(drawn)) drawn = 0.5f;
  }
  Raster matte = Matte(photo, trimap);
  for (float& share : matte.data) {
    share = std::clamp(share, 0.0f, 1.0f);
    if (share < kCertain) share = 0;
    if (share > 1 - kCertain) share = 1;
  }
  return matte;
}

}  // namespace insitu
