// SPDX-License-Identifier: Apache-2.0
#include "hogel/provenance.h"

#include <gtest/gtest.h>

#include "hogel/units.h"

namespace hogel::image {
namespace {

Camera a_camera() {
    Camera camera;
    camera.eye = {-0.01, 1.0 / 3, 0.3};
    camera.focus_depth = -4e-3;
    camera.focus_slope_x = 0.125;
    camera.pupil = 6e-3;
    camera.picture = {400, 300, 5e-5, 6e-5, 1e-3, -2e-3};
    return camera;
}

TEST(Provenance, a_camera_survives_as_text) {
    const auto read = parse_camera(describe(a_camera()));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, a_camera());
}

TEST(Provenance, texts_that_are_no_camera_are_none) {
    const std::string text = describe(a_camera());
    for (const std::string& wrong : {std::string(), std::string("eye"), std::string("Canon EOS"), text + " 7",
                                     text.substr(0, text.size() - 10), "eye 0 0 -1" + text.substr(text.find(" focus"))})
        EXPECT_FALSE(parse_camera(wrong)) << wrong;
}

TEST(Provenance, survives_as_metadata) {
    const Provenance provenance{{{"scene", "pumpkin"}, {"command", "hogel render"}}, a_camera()};
    const Provenance read = to_provenance(to_metadata(provenance));
    EXPECT_EQ(read, provenance);
    const Provenance none{{{"scene", "pumpkin"}}, {}};
    EXPECT_EQ(to_provenance(to_metadata(none)), none);
}

TEST(Provenance, an_unreadable_camera_stays_an_entry) {
    const Metadata metadata{{"camera", "Canon EOS"}, {"date", "today"}};
    const Provenance read = to_provenance(metadata);
    EXPECT_FALSE(read.camera);
    EXPECT_EQ(read.entries, metadata);
    // An invalid camera entry is kept when hogel adds a camera.
    EXPECT_EQ(to_metadata({metadata, a_camera()}).size(), 3u);
}

TEST(Provenance, history_of_many_entries_takes_linear_time) {
    Metadata before;
    for (int i = 0; i < 300000; ++i) before.emplace_back("key" + std::to_string(i), "text");
    EXPECT_EQ(with_history({{"key7", "other"}, {"key8", "text"}}, before).size(), 300001u);
}

TEST(Provenance, history_keeps_every_generation) {
    const Metadata render{{"software", "hogel 1"}, {"command", "render"}, {"scene", "ball"}};
    const Metadata hologram = with_history({{"software", "hogel 1"}, {"command", "hologram"}}, render);
    const Metadata photo = with_history({{"software", "hogel 2"}, {"command", "photo"}}, hologram);
    EXPECT_EQ(photo, (Metadata{{"software", "hogel 2"},
                               {"command", "photo"},
                               {"source software", "hogel 1"},
                               {"source command", "hologram"},
                               {"source source command", "render"},
                               {"scene", "ball"}}));
}

}  // namespace
}  // namespace hogel::image
