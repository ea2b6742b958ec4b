// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/sha256.h"

#include <gtest/gtest.h>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

TEST(Sha256, IsThatOfTheStandardsExamples) {  // FIPS 180-4
  const ScratchFolder folder;
  EXPECT_EQ(Sha256(folder.Write("abc", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256(folder.Write("million", std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfATextIsThatOfTheFile) {
  EXPECT_EQ(Sha256OfText("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, RefusesWhatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_THROW(Sha256(folder.path() / "missing"), InputError);
}

}  // namespace
}  // namespace insitu
