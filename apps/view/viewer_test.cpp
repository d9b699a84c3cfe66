// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <thread>

#include "hogel/error.h"
#include "view/light_field_viewable.h"

namespace hogel::view {
namespace {

constexpr std::size_t memory = std::size_t{1} << 28;

LightField grey() {
    const LightFieldGrid grid{8, 8, 0.25e-3, 4, 4, Perspective{0.08, 0.08}, 1};
    auto buffer = std::make_shared<LightFieldBuffer>(grid, false);
    for (float& value : buffer->radiance.elements()) value = 0.5f;
    return LightField(buffer);
}

// Holograms whose computation lasts until no page waits for them.
struct Endless {
    std::shared_ptr<Viewer> viewer = std::make_shared<Viewer>(Access("127.0.0.1", 80, ""));
    std::promise<void> began, ended;

    Endless() {
        const auto make = [this]() -> Fields {
            began.set_value();
            while (viewer->is_watched()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ended.set_value();
            throw Error(ErrorCode::cancelled, "stopped");
        };
        viewer->describe(nlohmann::ordered_json::object());
        viewer->show(std::make_shared<LightFieldViewable>(grey(), grey(), memory, Progress(),
                                                          std::make_unique<Waves>(make, 1, memory, Progress())));
    }
    std::function<void()> ask(std::promise<Response>& response) {
        return viewer->answer({"GET", "/picture", "by=waves&resolution=8x8", "127.0.0.1:80", "", ""},
                              [&response](Response made) { response.set_value(std::move(made)); });
    }
};

TEST(Viewer, makes_nothing_that_nobody_waits_for) {
    constexpr std::chrono::seconds patience(30);
    Endless endless;
    EXPECT_FALSE(endless.viewer->is_watched());
    std::promise<Response> first, second;
    const auto give_up = endless.ask(first), give_up_waiting = endless.ask(second);
    ASSERT_TRUE(give_up);
    ASSERT_EQ(endless.began.get_future().wait_for(patience), std::future_status::ready);
    give_up();
    EXPECT_TRUE(endless.viewer->is_watched());
    give_up_waiting();
    EXPECT_FALSE(endless.viewer->is_watched());
    EXPECT_EQ(endless.ended.get_future().wait_for(patience), std::future_status::ready);
    EXPECT_EQ(first.get_future().get().status, 503u);
    EXPECT_EQ(second.get_future().wait_for(std::chrono::milliseconds(0)), std::future_status::timeout);
}

// The page's end of a conversation: the messages of one type.
class Page final : public Socket {
  public:
    explicit Page(std::string type) : type_(std::move(type)) {}
    void send_text(std::string text) override {
        const auto message = nlohmann::json::parse(text);
        if (message["type"] == type_) messages.push_back(message);
    }
    void send_picture(std::string) override {}
    bool is_busy() const override { return false; }

    std::vector<nlohmann::json> messages;

  private:
    std::string type_;
};

TEST(Viewer, says_over_the_stream_what_parameters_a_refused_picture_is_about) {
    const auto viewer = std::make_shared<Viewer>(Access("127.0.0.1", 80, ""));
    viewer->describe(nlohmann::ordered_json::object());
    viewer->show(std::make_shared<LightFieldViewable>(grey(), grey(), memory, Progress()));
    const auto page = std::make_shared<Page>("error");
    const auto conversation = viewer->open(page);
    for (const char* view : {"eye=0,0,-1mm", "focus=1", "by=waves", "by=side&eyes=63mm", "nonsense=1"})
        conversation->receive(std::string("picture?id=7&") + view);
    std::vector<std::vector<std::string>> parameters;
    for (const auto& message : page->messages) parameters.push_back(message["parameter"]);
    EXPECT_EQ(parameters, (std::vector<std::vector<std::string>>{{"eye"}, {"focus"}, {"by"}, {"by"}, {}}));
    EXPECT_EQ(page->messages.front()["id"], "7");
}

TEST(Viewer, tells_pages_what_parameters_a_problem_is_about) {
    const auto viewer = std::make_shared<Viewer>(Access("127.0.0.1", 80, ""));
    viewer->describe(nlohmann::ordered_json::object());
    const auto page = std::make_shared<Page>("problem");
    const auto conversation = viewer->open(page);
    viewer->report_error("no", {"hogels", "size"});
    ASSERT_EQ(page->messages.size(), 1u);
    EXPECT_EQ(page->messages[0]["parameter"], nlohmann::json({"hogels", "size"}));
}

}  // namespace
}  // namespace hogel::view
