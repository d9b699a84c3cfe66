// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <cmath>
#include <optional>
#include <utility>

#include "view/answers.h"
#include "view/page.h"
#include "view/session.h"

namespace hogel::view {
namespace {

using Words = std::map<std::string, std::string>;
using Reply = std::function<void(Response)>;

// Computes the response to a GET request on a worker's thread.
Response make_response(const std::string& path, Viewable& viewable, const Words& words, const Progress& progress) {
    const PictureQuery query = parse_picture_query(words);
    if (path == "/levels") {
        const auto encoding = words.find("encoding");
        return answer_with(
            to_json(viewable.count_levels(encoding == words.end() ? "phase" : encoding->second, progress)));
    }
    if (path == "/sharpness") return answer_with(to_json(viewable.find_focus(progress)));
    if (path == "/picture") return {200, type_of(query), encode(viewable.photograph(query, progress), query)};
    PictureQuery png = query;
    png.format = "png";
    return {200, type_of(png),
            encode(viewable.inside(query, parse_pick_point(words), parse_inside(words), progress), png)};
}

}  // namespace

Viewer::Viewer(Access access) : access_(std::move(access)) {}

Viewer::~Viewer() = default;

std::shared_ptr<Viewable> Viewer::viewable() const {
    const std::lock_guard lock(mutex_);
    return viewable_;
}

void Viewer::show(std::shared_ptr<Viewable> viewable) {
    {
        const std::lock_guard lock(mutex_);
        viewable_.swap(viewable);
        ++generation_;
    }
    tell(state());
}

void Viewer::set_controller(Controller* controller) {
    const std::lock_guard lock(mutex_);
    controller_ = controller;
}

void Viewer::describe(Json facts) {
    {
        const std::lock_guard lock(mutex_);
        description_ = std::move(facts);
    }
    tell(state());
}

void Viewer::report_error(const std::string& message, const std::vector<std::string>& parameter) {
    tell(dump({{"type", "problem"}, {"message", message}, {"parameter", parameter}}));
}

void Viewer::set_status(const std::string& status, double fraction) {
    {
        const std::lock_guard lock(mutex_);
        // Steps of 2 % suffice for a progress bar.
        if (status == status_ && fraction < 1 && std::abs(fraction - fraction_) < 0.02) return;
        status_ = status;
        fraction_ = fraction;
    }
    tell(state());
}

void Viewer::tell(const std::string& text) {
    std::vector<std::shared_ptr<Socket>> sockets;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [client, socket] : sockets_)
            if (auto connected = socket.lock()) sockets.push_back(std::move(connected));
    }
    for (const auto& socket : sockets) socket->send_text(text);
}

// Returns the state for the page, in SI units.
std::string Viewer::state() const {
    const std::lock_guard lock(mutex_);
    Json json{{"type", "state"},
              {"work", status_},
              {"fraction", fraction_},
              {"ready", viewable_ != nullptr},
              {"generation", generation_}};
    json.update(description_);
    if (viewable_) {
        json["width_m"] = viewable_->width();
        json["height_m"] = viewable_->height();
        json["exposure"] = viewable_->exposure();
        json["rays"] = viewable_->has_rays();
        json["has_original"] = viewable_->has_original();
        json["looks"] = viewable_->looks();
        json.update(viewable_->facts());
    }
    return dump(json);
}

std::string Viewer::refusal(const Request& request) const {
    std::string token;
    try {
        const Words words = parse_query(request.query);
        if (const auto found = words.find("token"); found != words.end()) token = found->second;
    } catch (const Error&) {
        // A malformed query has no token. If none is required, its error is reported later.
    }
    return access_.refusal({request.host, request.origin, request.fetch_site, token});
}

bool Viewer::is_watched() const {
    const std::lock_guard lock(mutex_);
    return !sockets_.empty() || !http_clients_.empty();
}

bool Viewer::trusts(const Request& request) const { return refusal(request).empty(); }

// Returns static files and refusals.
std::optional<Response> Viewer::answer_without_viewable(const Request& request) const {
    if (request.method == "HEAD") return Response{405, json_type, ""};  // a response to HEAD has no body
    if (request.method != "GET") return failure(405, "only GET is answered");
    for (const PageFile& file : page_files())
        if (file.path == request.path) {
            const std::string why = access_.refusal_of_page({request.host, request.origin, request.fetch_site, ""});
            if (!why.empty()) return failure(403, why);
            return Response{200, std::string(file.type), std::string(file.bytes)};
        }
    if (const std::string why = refusal(request); !why.empty()) return failure(403, why);
    return {};
}

std::function<void()> Viewer::answer(const Request& request, std::function<void(Response)> reply) {
    std::function<void()> cancel;
    if (std::optional<Response> response = answer_without_viewable(request))
        reply(std::move(*response));
    else
        attempt([&] { cancel = answer_about(request, reply); }, reply);
    return cancel;
}

std::function<void()> Viewer::answer_about(const Request& request, const Reply& reply) {
    const auto at_once = [&](Response response) {
        reply(std::move(response));
        return std::function<void()>();
    };
    if (request.path == "/state") return at_once({200, json_type, state()});
    const auto viewable = this->viewable();
    bool known = false;
    for (const char* path : {"/picture", "/reading", "/inside", "/sharpness", "/levels"})
        known = known || request.path == path;
    if (!known) return at_once(failure(404, "there is no such page"));
    if (!viewable) return at_once(failure(503, "the input is still being opened"));
    const Words words = parse_query(request.query);
    const PictureQuery query = parse_picture_query(words);
    const bool picture = request.path == "/picture";
    if (picture)
        viewable->require(query);
    else
        viewable->camera(query);
    if (request.path == "/reading")
        return at_once(answer_with(to_json(viewable->read(query, parse_pick_point(words)), query.id)));
    if (request.path == "/inside") parse_pick_point(words);
    const bool waves = picture ? needs_waves(query.by) : request.path == "/sharpness" || request.path == "/levels";
    return enqueue(waves ? waves_ : rays_, [viewable, words, path = request.path, reply](std::stop_token stop) {
        attempt([&] { reply(make_response(path, *viewable, words, Progress(stop))); }, reply);
    });
}

// Queues the work of one answer, which newer requests do not replace. Returns a function that cancels it.
std::function<void()> Viewer::enqueue(Worker& worker, std::function<void(std::stop_token)> work) {
    const std::uint64_t client = ++clients_;
    {
        const std::lock_guard lock(mutex_);
        http_clients_.insert(client);
    }
    const auto work_and_forget = [this, client, work = std::move(work)](const std::stop_token& stop) {
        work(stop);
        forget(client);
    };
    worker.put(client, {work_and_forget, true});
    return [this, &worker, client] {
        forget(client);
        worker.drop(client);
    };
}

void Viewer::forget(std::uint64_t client) {
    const std::lock_guard lock(mutex_);
    http_clients_.erase(client);
}

std::variant<std::filesystem::path, Response> Viewer::destination_for(const Request& request) {
    if (request.path != "/drop") return failure(405, "only GET is answered");
    if (const std::string why = refusal(request); !why.empty()) return failure(403, why);
    // The page's script sends an Origin; a request without it may come from a form of another page.
    if (request.origin.empty()) return failure(403, "only this server's page sends files");
    std::variant<std::filesystem::path, Response> destination = failure(503, "the server is stopping");
    attempt(
        [&] {
            const std::lock_guard lock(mutex_);
            const Words words = parse_query(request.query);
            const auto name = words.find("name");
            if (controller_ != nullptr)
                destination = controller_->destination_for(name == words.end() ? "" : name->second);
        },
        [&](Response refused) { destination = std::move(refused); });
    return destination;
}

Response Viewer::take(const Request& request, const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    if (controller_ != nullptr && !parse_query(request.query).contains("more")) controller_->open(file);
    return {200, json_type, dump({{"type", "taken"}})};
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
    if (const auto connected = socket.lock()) connected->send_text(state());
    return std::make_shared<Session>(weak_from_this(), std::move(socket), pictures, readings);
}

}  // namespace hogel::view
