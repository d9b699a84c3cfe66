// SPDX-License-Identifier: Apache-2.0
#include "view/settings.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hogel/error.h"
#include "view/drop_folder.h"

namespace hogel::view {
namespace {

using Words = Settings::Words;

// The settings of "hogel view INPUT --NAME TEXT ...".
Settings settings_of(const std::string& input, const Words& words) {
    ViewerParameters values;
    Parameters table;
    values.declare(table);
    table.look_up("input")->read({input}, "input");
    for (const auto& [name, text] : words) table.look_up(name)->read_value(text, name);
    return {table, [](const std::string& command, std::string_view option) {
                return command == "make" ? option == "hogels" || option == "rotate" || option == "size"
                                         : option != "port" && option != "no-browser" && option != "original" &&
                                               (option != "looks" || command == "photo");
            }};
}

TEST(Settings, changes_are_those_of_a_command_line) {
    const Settings first =
        settings_of("pumpkin", {{"hogels", "60"}, {"port", "0"}, {"size", "9mm"}, {"no-browser", "yes"}});
    EXPECT_EQ(first.options().render.hogels.columns, 60u);
    EXPECT_EQ(first.photo_command(), "hogel photo pumpkin --hogels 60 --size 9mm");
    const Settings changed = first.with({{"hogels", "70x50"}, {"rotate", "0,20,0deg"}, {"size", "8mm"}});
    EXPECT_EQ(changed.options().render.hogels.rows, 50u);
    EXPECT_NEAR(changed.options().render.size, 8e-3, 1e-12);
    EXPECT_EQ(changed.make_command(), "hogel make pumpkin --hogels 70x50 --size 8mm --rotate 0,20,0deg -o made");
    EXPECT_FALSE(changed.same_light_field(first));
    EXPECT_TRUE(changed.same_light_field(changed.with({{"pitch", "2um"}})));
    EXPECT_FALSE(changed.same_light_field(changed.with({{"fov", "20deg"}})));
    // Without a value it is that of the first command line.
    const Settings back = changed.with({{"hogels", ""}, {"rotate", ""}, {"size", ""}});
    EXPECT_EQ(back.photo_command(), first.photo_command());
    EXPECT_TRUE(back.with({}).options().render.scene.lights.empty());
    EXPECT_EQ(first.with({{"light", "1,1,1:red"}}).photo_command(),
              "hogel photo pumpkin --hogels 60 --size 9mm --light 1,1,1:red");
}

// A file may be called like the value of an option, like a command, or like the input before it.
TEST(Settings, names_of_files_are_nothing_else) {
    const Settings first = settings_of("pumpkin", {{"hogels", "40"}, {"directions", "16"}});
    for (const std::string name : {"40", "16", "view", "render", "help", "pumpkin", "hogels"}) {
        const Settings dropped = first.for_input("sphere", name);
        EXPECT_EQ(dropped.options().render.hogels.columns, 40u) << name;
        EXPECT_EQ(dropped.input(), "sphere");
        EXPECT_EQ(dropped.options().input, name);
        EXPECT_EQ(dropped.photo_command(), "hogel photo " + name + " --hogels 40 --directions 16");
        EXPECT_EQ(dropped.with({{"hogels", "50"}}).photo_command(),
                  "hogel photo " + name + " --hogels 50 --directions 16");
        EXPECT_EQ(dropped.for_input("sphere", "one mesh.ply").photo_command(),
                  "hogel photo 'one mesh.ply' --hogels 40 --directions 16");
    }
    EXPECT_EQ(settings_of("pumpkin", {{"original", "pumpkin"}, {"hogels", "40"}}).photo_command(),
              "hogel photo pumpkin --hogels 40");
}

TEST(Settings, refuse_what_a_command_line_would) {
    const Settings first = settings_of("pumpkin", {});
    for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{{"hogels", "0"},
                                                                                      {"hogels", "many"},
                                                                                      {"size", "-1mm"},
                                                                                      {"front", "7"},
                                                                                      {"rotate", "1,2deg"},
                                                                                      {"light", "x"},
                                                                                      {"fov", "200deg"},
                                                                                      {"threads", "2"},
                                                                                      {"memory", "1"},
                                                                                      {"host", "0.0.0.0"},
                                                                                      {"", "x"}})
        EXPECT_THROW(first.with({{name, value}}), Error) << name << value;
    // The error names the parameter once.
    try {
        first.with({{"hogels", "0"}, {"size", "8mm"}});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.parameter(), "hogels");
        EXPECT_TRUE(first.table().describe(error).starts_with("--hogels: '0' is not")) << first.table().describe(error);
    }
    // Nor does a value become another option.
    EXPECT_THROW(first.with({{"size", "8mm --token x"}}), Error);
}

TEST(Settings, make_holograms_by_themselves_with_options_that_make_lacks) {
    EXPECT_EQ(settings_of("pumpkin", {{"wavelength", "532nm"}}).make_command(),
              "hogel hologram pumpkin --wavelength 532nm -o hologram.h5");
    EXPECT_EQ(settings_of("pumpkin", {{"looks", "4"}}).make_command(), "hogel make pumpkin -o made");
}

TEST(DropFolder, keeps_what_is_shown_and_forgets_what_was) {
    std::filesystem::path first, second;
    {
        DropFolder folder;
        first = folder.destination_for("a.gltf");
        EXPECT_EQ(folder.destination_for("a.bin").parent_path(), first.parent_path());
        std::ofstream(first) << "x";
        EXPECT_EQ(std::filesystem::status(first.parent_path()).permissions() & std::filesystem::perms::all,
                  std::filesystem::perms::owner_all);
        folder.opened();
        second = folder.destination_for("b.ply");
        EXPECT_NE(second.parent_path(), first.parent_path());
        folder.opened();
        EXPECT_TRUE(std::filesystem::exists(first));  // until the second is shown
        folder.forget_earlier();
        EXPECT_FALSE(std::filesystem::exists(first.parent_path()));
        EXPECT_TRUE(std::filesystem::exists(second.parent_path()));
        for (const char* name : {"", ".", "..", "../a", "/a", "a/b", ".hidden", "-o"})
            EXPECT_THROW(folder.destination_for(name), Error) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(second.parent_path()));
}

}  // namespace
}  // namespace hogel::view
