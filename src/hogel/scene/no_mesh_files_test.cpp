// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

TEST(WithoutAssimp, mesh_files_are_refused_by_name) {
    try {
        import_scene("bunny.ply");
        FAIL() << "read a mesh file";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_built_in);
        EXPECT_STREQ(error.what(),
                     "bunny.ply: this build of hogel lacks assimp; the build option HOGEL_ASSIMP=ON brings it");
    }
}

}  // namespace
}  // namespace hogel
