// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "hogel/error.h"
#include "hogel/screen.h"
#include "hogel/units.h"
#include "view/page.h"

namespace hogel::view {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using Words = std::map<std::string, std::string>;

constexpr const char* json_type = "application/json";

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Response failure(unsigned status, const std::string& why) {
    return {status, json_type, dump({{"type", "error"}, {"message", why}})};
}

Response failure(const Error& error) {
    return failure(error.code() == ErrorCode::usage       ? 400
                   : error.code() == ErrorCode::cancelled ? 503
                                                          : 500,
                   error.what());
}

struct Developed {
    std::string bytes;
    Json about;
};

Developed develop(Subject& subject, const View& view, const std::stop_token& stop) {
    const Clock::time_point began = Clock::now();
    const Image picture = subject.photograph(view, Progress(stop));
    const double exposure = subject.exposure(view);
    const std::vector<unsigned char> file =
        view.format == "png" ? encode_png(picture, exposure) : encode_jpeg(picture, exposure, view.quality);
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return {{file.begin(), file.end()},
            {{"type", "picture"},
             {"id", view.id},
             {"format", view.format},
             {"width", picture.width()},
             {"height", picture.height()},
             {"exposure", exposure},
             {"pupil_samples", view.pupil_samples},
             {"hogels", subject.shown().hogels_s},
             {"seconds", seconds}}};
}

constexpr double degrees = 180 / std::numbers::pi;

Json told(const Reading& reading, const std::string& id) {
    Json json{{"type", "reading"},
              {"id", id},
              {"x_m", reading.x},
              {"y_m", reading.y},
              {"across_deg", reading.across * degrees},
              {"up_deg", reading.up * degrees},
              {"inside", reading.inside}};
    if (reading.inside) json["radiance"] = reading.radiance;
    if (reading.depth) json["depth_m"] = *reading.depth;
    return json;
}

}  // namespace

// One page that looks.
class Viewer::Talk final : public Conversation {
  public:
    Talk(std::weak_ptr<Viewer> viewer, std::weak_ptr<Socket> socket, std::uint64_t pictures, std::uint64_t readings)
        : viewer_(std::move(viewer)), socket_(std::move(socket)), pictures_(pictures), readings_(readings) {}
    ~Talk() override {
        const auto viewer = viewer_.lock();
        if (!viewer) return;
        viewer->worker_.drop(pictures_);
        viewer->worker_.drop(readings_);
        const std::lock_guard lock(viewer->mutex_);
        viewer->sockets_.erase(pictures_);
    }

    void receive(std::string_view text) override {
        const auto viewer = viewer_.lock();
        if (!viewer) return;
        try {
            const std::size_t end = std::min(text.find('?'), text.size());
            const std::string_view verb = text.substr(0, end);
            const Words words = parse_query(end < text.size() ? text.substr(end + 1) : "");
            if (verb == "picture")
                ask(*viewer, parse_view(words));
            else if (verb == "reading" || verb == "focus")
                ask_there(*viewer, parse_view(words), parse_spot(words), verb == "focus");
            else
                throw Error(ErrorCode::usage, "a message begins with picture?, reading? or focus?");
        } catch (const Error& error) {
            send(socket_, failure(error).body);
        }
    }

    void resume() override {
        const auto viewer = viewer_.lock();
        if (viewer && held_) ask(*viewer, *std::exchange(held_, {}));
    }

  private:
    static void send(const std::weak_ptr<Socket>& to, std::string text) {
        if (const auto socket = to.lock()) socket->send_text(std::move(text));
    }

    // What the page cannot take yet is held back, the newest alone.
    void ask(Viewer& viewer, const View& view) {
        const auto socket = socket_.lock();
        const auto subject = viewer.subject();
        if (!socket || !subject) return;
        if (socket->is_busy()) {
            held_ = view;
            return;
        }
        subject->camera(view);  // throws for one that makes no sense
        const auto work = [subject, view, to = socket_](std::stop_token stop) {
            try {
                Developed developed = develop(*subject, view, stop);
                if (const auto there = to.lock()) there->send_picture(dump(developed.about) + developed.bytes);
            } catch (const Error& error) {
                if (error.code() != ErrorCode::cancelled) send(to, failure(error).body);
            } catch (const std::exception& error) {
                send(to, failure(500, error.what()).body);
            }
        };
        viewer.worker_.put(pictures_, {work, view.moving});
    }

    void ask_there(Viewer& viewer, const View& view, const Spot& spot, bool focus) {
        const auto subject = viewer.subject();
        if (!subject) return;
        subject->camera(view);
        const auto work = [subject, view, spot, focus, to = socket_](std::stop_token stop) {
            try {
                if (focus)
                    send(to, dump({{"type", "focus"}, {"depth_m", subject->focus(view, spot, Progress(stop))}}));
                else
                    send(to, dump(told(subject->read(view, spot), view.id)));
            } catch (const Error& error) {
                if (error.code() != ErrorCode::cancelled) send(to, failure(error).body);
            } catch (const std::exception& error) {
                send(to, failure(500, error.what()).body);
            }
        };
        viewer.worker_.put(readings_, {work, false});
    }

    std::weak_ptr<Viewer> viewer_;
    std::weak_ptr<Socket> socket_;
    std::uint64_t pictures_, readings_;  // as clients of the worker, which takes them in turn
    std::optional<View> held_;
};

Viewer::Viewer(Access access, std::string name, std::string photo)
    : access_(std::move(access)), name_(std::move(name)), photo_(std::move(photo)) {}

Viewer::~Viewer() = default;

std::shared_ptr<Subject> Viewer::subject() const {
    const std::lock_guard lock(mutex_);
    return subject_;
}

void Viewer::show(std::shared_ptr<Subject> subject) {
    {
        const std::lock_guard lock(mutex_);
        subject_ = std::move(subject);
    }
    tell(state());
}

void Viewer::say(const std::string& what, double fraction) {
    {
        const std::lock_guard lock(mutex_);
        // Often enough for a bar, and for few messages.
        if (what == what_ && fraction < 1 && std::abs(fraction - fraction_) < 0.02) return;
        what_ = what;
        fraction_ = fraction;
    }
    tell(state());
}

void Viewer::tell(const std::string& text) {
    std::vector<std::shared_ptr<Socket>> sockets;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [client, socket] : sockets_)
            if (auto there = socket.lock()) sockets.push_back(std::move(there));
    }
    for (const auto& socket : sockets) socket->send_text(text);
}

// What the page needs to know of the light field; SI units.
std::string Viewer::state() const {
    const std::lock_guard lock(mutex_);
    Json json{{"type", "state"}, {"name", name_},         {"photo", photo_},
              {"work", what_},   {"fraction", fraction_}, {"ready", subject_ != nullptr}};
    if (subject_) {
        const LightFieldGrid& grid = subject_->grid();
        json["width_m"] = grid.width();
        json["height_m"] = grid.height();
        json["hogels_s"] = grid.hogels_s;
        json["hogels_t"] = grid.hogels_t;
        json["shown_hogels_s"] = subject_->shown().hogels_s;
        json["directions_u"] = grid.directions_u;
        json["directions_v"] = grid.directions_v;
        json["tan_half_u"] = grid.half_u();
        json["tan_half_v"] = grid.half_v();
        json["center_u"] = grid.center_u();
        json["center_v"] = grid.center_v();
        json["channels"] = grid.channels;
        json["depth"] = subject_->has_depth();
        json["exposure"] = subject_->exposure();
    }
    return dump(json);
}

std::string Viewer::refusal(const Request& request) const {
    std::string token;
    try {
        const Words words = parse_query(request.query);
        if (const auto found = words.find("token"); found != words.end()) token = found->second;
    } catch (const Error&) {
        // A damaged query holds no token. Where none is asked for, what is wrong with it is said later.
    }
    return access_.refusal({request.host, request.origin, request.fetch_site, token});
}

void Viewer::answer(const Request& request, std::function<void(Response)> reply) {
    if (request.method == "HEAD") return reply({405, json_type, ""});  // whose answer has no body
    if (request.method != "GET") return reply(failure(405, "only GET is answered"));
    for (const PageFile& file : page_files())
        if (file.path == request.path) {
            const std::string why = access_.refusal_of_page({request.host, request.origin, request.fetch_site, ""});
            if (!why.empty()) return reply(failure(403, why));
            return reply({200, std::string(file.type), std::string(file.bytes)});
        }
    if (const std::string why = refusal(request); !why.empty()) return reply(failure(403, why));
    try {
        if (request.path == "/state") return reply({200, json_type, state()});
        const auto subject = this->subject();
        if (request.path != "/picture" && request.path != "/reading")
            return reply(failure(404, "there is no such page"));
        if (!subject) return reply(failure(503, "the light field is not there yet"));
        const Words words = parse_query(request.query);
        const View view = parse_view(words);
        subject->camera(view);
        if (request.path == "/reading")
            return reply({200, json_type, dump(told(subject->read(view, parse_spot(words)), view.id))});
        // Waits in turn with the pictures of others; nothing takes its place.
        worker_.put(++clients_, {[subject, view, reply](std::stop_token stop) {
                                     try {
                                         reply({200, view.format == "png" ? "image/png" : "image/jpeg",
                                                develop(*subject, view, stop).bytes});
                                     } catch (const Error& error) {
                                         reply(failure(error));
                                     } catch (const std::exception& error) {
                                         reply(failure(500, error.what()));
                                     }
                                 },
                                 true});
    } catch (const Error& error) {
        reply(failure(error));
    }
}

Response Viewer::admit(const Request& request) {
    if (request.path != "/live") return failure(404, "there is no such page");
    if (const std::string why = refusal(request); !why.empty()) return failure(403, why);
    return {101, "", ""};
}

std::shared_ptr<Conversation> Viewer::open(std::weak_ptr<Socket> socket) {
    const std::uint64_t pictures = ++clients_, readings = ++clients_;
    {
        const std::lock_guard lock(mutex_);
        sockets_[pictures] = socket;
    }
    if (const auto there = socket.lock()) there->send_text(state());
    return std::make_shared<Talk>(weak_from_this(), std::move(socket), pictures, readings);
}

}  // namespace hogel::view
