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

void send(const std::weak_ptr<Socket>& weak_socket, std::string text) {
    if (const auto socket = weak_socket.lock()) socket->send_text(std::move(text));
}

// Calls `work` and sends its errors, except cancellation by a newer query. An error of a picture carries its id.
template <class Work>
void attempt_for(const std::weak_ptr<Socket>& weak_socket, const Work& work, const std::string& picture = "") {
    constexpr unsigned stopped = 503;
    attempt(work, [&](const Response& refused) {
        if (refused.status == stopped) return;
        Json json = Json::parse(refused.body);
        if (!picture.empty()) json["id"] = picture;
        send(weak_socket, dump(json));
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
            const PictureQuery query = parse_picture_query(words);
            attempt_for(
                socket_, [&] { request_picture(*viewer, query); }, query.id);
        } else if (verb == "reading" || verb == "focus")
            request_at_point(*viewer, parse_picture_query(words), parse_pick_point(words), verb == "focus");
        else if (verb == "change")
            change(*viewer, words);
        else
            throw Error(ErrorCode::usage, "message: expected picture?, reading?, focus? or change? at the beginning");
    });
}

void Viewer::Session::resume() {
    const auto viewer = viewer_.lock();
    if (!viewer || !pending_) return;
    const PictureQuery newest = *pending_;
    attempt_for(
        socket_, [&] { request_picture(*viewer, newest); }, newest.id);
}

// Keeps only the newest query while the socket is busy.
void Viewer::Session::request_picture(Viewer& viewer, const PictureQuery& query) {
    const auto socket = socket_.lock();
    const auto viewable = viewer.viewable();
    if (!socket || !viewable) return;
    if (socket->is_busy()) {
        pending_ = query;
        return;
    }
    pending_.reset();
    viewable->require(query);
    const auto work = [viewable, query, weak_socket = socket_](std::stop_token stop) {
        const Clock::time_point began = Clock::now();
        const auto shown = [&](const Photograph& photograph) {
            const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
            const Json description = to_json(photograph, query, *viewable, seconds);
            const auto live_socket = weak_socket.lock();
            // Looks may be faster than the connection: only the last must be sent.
            const bool last = !description.contains("looks") || description["looks"] == description["of_looks"];
            if (live_socket && (last || !live_socket->is_busy()))
                live_socket->send_picture(dump(description) + encode(photograph, query));
        };
        attempt_for(
            weak_socket, [&] { viewable->photograph(query, shown, Progress(stop)); }, query.id);
    };
    const bool rays = !needs_waves(query.by);
    (rays ? viewer.waves_ : viewer.rays_).drop(pictures_);
    (rays ? viewer.rays_ : viewer.waves_).put(pictures_, {work, query.moving});
}

void Viewer::Session::change(Viewer& viewer, Words words) {
    const bool moving = words.erase("moving") > 0;
    const std::lock_guard lock(viewer.mutex_);
    if (viewer.controller_ != nullptr) viewer.controller_->change(words, moving);
}

void Viewer::Session::request_at_point(Viewer& viewer, const PictureQuery& query, const PickPoint& point, bool focus) {
    const auto viewable = viewer.viewable();
    if (!viewable) return;
    viewable->require(query);
    const auto work = [viewable, query, point, focus, weak_socket = socket_](std::stop_token stop) {
        attempt_for(weak_socket, [&] {
            if (focus)
                send(weak_socket,
                     dump({{"type", "focus"}, {"depth_m", viewable->focus(query, point, Progress(stop))}}));
            else
                send(weak_socket, dump(to_json(viewable->read(query, point), query.id)));
        });
    };
    viewer.rays_.put(readings_, {work, false});
}

}  // namespace hogel::view
