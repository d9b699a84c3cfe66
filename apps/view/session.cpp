// SPDX-License-Identifier: Apache-2.0
#include "view/session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "view/answers.h"

namespace hogel::view {
namespace {

using Clock = std::chrono::steady_clock;
using Words = std::map<std::string, std::string>;

void send(const std::weak_ptr<Socket>& to, std::string text) {
    if (const auto socket = to.lock()) socket->send_text(std::move(text));
}

// Work whose failure is told, unless it was stopped for a newer view. That of a picture has the picture's id.
template <class Work>
void attempt_for(const std::weak_ptr<Socket>& to, const Work& work, const std::string& picture = "") {
    constexpr unsigned stopped = 503;
    attempt(work, [&](const Response& refused) {
        if (refused.status == stopped) return;
        Json json = Json::parse(refused.body);
        if (!picture.empty()) json["id"] = picture;
        send(to, dump(json));
    });
}

}  // namespace

Viewer::Session::Session(std::weak_ptr<Viewer> viewer, std::weak_ptr<Socket> socket, std::uint64_t pictures,
                         std::uint64_t readings)
    : viewer_(std::move(viewer)), socket_(std::move(socket)), pictures_(pictures), readings_(readings) {}

Viewer::Session::~Session() {
    const auto viewer = viewer_.lock();
    if (!viewer) return;
    viewer->rays_.drop(pictures_);
    viewer->waves_.drop(pictures_);
    viewer->rays_.drop(readings_);
    const std::lock_guard lock(viewer->mutex_);
    viewer->sockets_.erase(pictures_);
}

void Viewer::Session::receive(std::string_view text) {
    const auto viewer = viewer_.lock();
    if (!viewer) return;
    attempt_for(socket_, [&] {
        const std::size_t end = std::min(text.find('?'), text.size());
        const std::string_view verb = text.substr(0, end);
        const Words words = parse_query(end < text.size() ? text.substr(end + 1) : "");
        if (verb == "picture") {
            const View view = parse_view(words);
            attempt_for(
                socket_, [&] { ask(*viewer, view); }, view.id);
        } else if (verb == "reading" || verb == "focus")
            ask_there(*viewer, parse_view(words), parse_pick_point(words), verb == "focus");
        else if (verb == "change")
            change(*viewer, words);
        else
            throw Error(ErrorCode::usage, "a message begins with picture?, reading?, focus? or change?");
    });
}

void Viewer::Session::resume() {
    const auto viewer = viewer_.lock();
    if (!viewer || !held_) return;
    const View newest = *held_;
    attempt_for(
        socket_, [&] { ask(*viewer, newest); }, newest.id);
}

// What the page cannot take yet is held back, the newest alone.
void Viewer::Session::ask(Viewer& viewer, const View& view) {
    const auto socket = socket_.lock();
    const auto viewable = viewer.viewable();
    if (!socket || !viewable) return;
    if (socket->is_busy()) {
        held_ = view;
        return;
    }
    held_.reset();
    viewable->require(view);
    const auto work = [viewable, view, to = socket_](std::stop_token stop) {
        const Clock::time_point began = Clock::now();
        const auto shown = [&](const Photograph& photograph) {
            const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
            const Json about = to_json(photograph, view, *viewable, seconds);
            const auto there = to.lock();
            // Looks may follow each other faster than the page takes them: only the last is owed.
            const bool last = !about.contains("looks") || about["looks"] == about["of_looks"];
            if (there && (last || !there->is_busy())) there->send_picture(dump(about) + encode(photograph, view));
        };
        attempt_for(
            to, [&] { viewable->photograph(view, shown, Progress(stop)); }, view.id);
    };
    const bool rays = !needs_waves(view.by);
    (rays ? viewer.waves_ : viewer.rays_).drop(pictures_);
    (rays ? viewer.rays_ : viewer.waves_).put(pictures_, {work, view.moving});
}

void Viewer::Session::change(Viewer& viewer, Words words) {
    const bool moving = words.erase("moving") > 0;
    const std::lock_guard lock(viewer.mutex_);
    if (viewer.controller_ != nullptr) viewer.controller_->change(words, moving);
}

void Viewer::Session::ask_there(Viewer& viewer, const View& view, const PickPoint& point, bool focus) {
    const auto viewable = viewer.viewable();
    if (!viewable) return;
    viewable->require(view);
    const auto work = [viewable, view, point, focus, to = socket_](std::stop_token stop) {
        attempt_for(to, [&] {
            if (focus)
                send(to, dump({{"type", "focus"}, {"depth_m", viewable->focus(view, point, Progress(stop))}}));
            else
                send(to, dump(to_json(viewable->read(view, point), view.id)));
        });
    };
    viewer.rays_.put(readings_, {work, false});
}

}  // namespace hogel::view
