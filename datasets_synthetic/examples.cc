// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/examples.h"

#include "calibration/files/error.h"
#include "datasets_synthetic/bridge.h"
#include "datasets_synthetic/courtyard.h"
#include "datasets_synthetic/gallery.h"

namespace insitu::demo {

const std::vector<std::string>& ExampleNames() {
  static const std::vector<std::string> names = {"gallery", "bridge", "courtyard"};
  return names;
}

SiteDescription DescribeExample(const std::string& name, int width, int height) {
  if (name == "gallery") return DescribeGallery(width, height);
  if (name == "bridge") return DescribeBridge(width, height);
  INSITU_CHECK(name == "courtyard");
  return DescribeCourtyard(width, height);
}

}  // namespace insitu::demo
