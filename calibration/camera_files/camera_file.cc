// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/camera_file.h"

#include "calibration/files/error.h"

namespace insitu {

void CameraFileOptions::Check() const { INSITU_CHECK(!photo_size || photo_size->minCoeff() > 0); }

}  // namespace insitu
