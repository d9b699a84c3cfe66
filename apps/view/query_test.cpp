// SPDX-License-Identifier: Apache-2.0
#include "view/query.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hogel/error.h"

namespace hogel::view {
namespace {

std::string refusal(std::string_view query) {
    try {
        parse_picture_query(parse_query(query));
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
}

TEST(Query, words_are_those_of_the_command_line) {
    const PictureQuery query = parse_picture_query(
        parse_query("eye=-30,0.5,300mm&focus=-4mm&pupil=0.5cm&resolution=640x480&pupil-samples=4&exposure=1.5&"
                    "display=log&format=png&moving=yes&id=17"));
    EXPECT_DOUBLE_EQ(query.camera.eye.x, -0.03);
    EXPECT_DOUBLE_EQ(query.camera.eye.z, 0.3);
    EXPECT_DOUBLE_EQ(query.camera.focus, -0.004);
    EXPECT_DOUBLE_EQ(query.camera.pupil, 0.005);
    EXPECT_EQ(query.camera.resolution.columns, 640u);
    EXPECT_EQ(query.camera.resolution.rows, 480u);
    EXPECT_EQ(query.pupil_samples, 4u);
    EXPECT_EQ(query.exposure, 1.5);
    EXPECT_TRUE(query.logarithmic);
    EXPECT_TRUE(query.moving);
    EXPECT_EQ(query.format, "png");
    EXPECT_EQ(query.id, "17");
}

TEST(Query, percent_stands_for_any_character) {
    EXPECT_EQ(parse_query("eye=0%2C0%2c300mm").at("eye"), "0,0,300mm");
    EXPECT_EQ(parse_query("a=%25&b&&c=").size(), 3u);
}

TEST(Query, what_makes_no_sense_is_refused) {
    for (const char* query : {"eye=0,0",
                              "pupil=1mm&f-number=3",
                              "eye=0,0,300",
                              "eye=0,0,1e300m",
                              "focus=4",
                              "focus=nan",
                              "pupil=0mm",
                              "pupil=-1mm",
                              "resolution=0",
                              "resolution=5000",
                              "resolution=99999999999999999999",
                              "resolution=4x",
                              "resolution=x4",
                              "pupil-samples=0",
                              "pupil-samples=1025",
                              "pupil-samples=1e3",
                              "exposure=0",
                              "exposure=-1",
                              "exposure=inf",
                              "exposure=nan",
                              "display=phase",
                              "format=gif",
                              "quality=101",
                              "quality=0",
                              "moving=maybe",
                              "path=/etc/passwd",
                              "id=1&id=2",
                              "eye=%",
                              "eye=%4",
                              "eye=%zz",
                              "id=%00",
                              "id=%0a"})
        EXPECT_NE(refusal(query), "") << query;
    EXPECT_NE(refusal(std::string(3000, 'a')), "");
    std::string many;
    for (int i = 0; i < 200; ++i) many += "a" + std::to_string(i) + "&";
    EXPECT_NE(refusal(many), "");
}

TEST(Query, errors_name_the_word_as_a_parameter) {
    const auto parameter = [](std::string_view query) {
        try {
            parse_picture_query(parse_query(query));
        } catch (const Error& error) {
            return error.parameter();
        }
        return std::string("no error");
    };
    EXPECT_EQ(parameter("eye=0,0"), "eye");
    EXPECT_EQ(parameter("focus=4"), "focus");
    EXPECT_EQ(parameter("pupil=4mm&exposure=0"), "exposure");
    EXPECT_EQ(parameter("pupil-samples=0"), "pupil_samples");
    EXPECT_EQ(parameter("path=1"), "");
    EXPECT_EQ(parameter("x=2"), "no error");
}

// Messages are one line and short, whatever is sent.
TEST(Query, messages_stay_short) {
    const std::string x(1900, 'x'), y(1900, 'y'), digits(1900, '9');
    for (const std::string& query :
         {fmt::format("display={}", x), fmt::format("{}=1", y), fmt::format("resolution={}", digits)})
        EXPECT_LT(refusal(query).size(), 200u);
}

TEST(Query, spots_lie_in_the_picture) {
    const PickPoint point = parse_pick_point(parse_query("x=0.25&y=1"));
    EXPECT_EQ(point.x, 0.25);
    EXPECT_EQ(point.y, 1);
    for (const char* query : {"x=0.5", "x=-0.1&y=0", "x=nan&y=0", "x=2&y=0", "x=&y="})
        EXPECT_THROW(parse_pick_point(parse_query(query)), Error) << query;
}

}  // namespace
}  // namespace hogel::view
