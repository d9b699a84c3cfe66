// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "view/access.h"
#include "view/server.h"
#include "view/viewable.h"
#include "view/worker.h"

namespace hogel::view {

/// What pages may change of what is looked at. Functions are called on the server's thread and return at once.
class Controller {
  public:
    virtual ~Controller() = default;
    /// Other values of options; the newest wins. @param moving  whether others will follow, so that coarse will do
    virtual void change(const std::map<std::string, std::string>& options, bool moving) = 0;
    /// Where a file is to be put that a page sends under this name, if it may send files. Throws Error(usage) for a
    /// name that is none of a file.
    virtual std::filesystem::path destination_for(const std::string& name) = 0;
    /// Opens a file that was put there.
    virtual void open(const std::filesystem::path& file) = 0;
};

/// The site of one light field or hologram: the page, pictures by HTTP, and conversations by WebSocket.
///
/// GET /picture?VIEW answers with a picture, /inside?VIEW&x=0.5&y=0.5&what=hogel with one of what lies there,
/// /reading?VIEW&x=&y= with what is known of it, /sharpness with the contrast of a hologram at many depths. In a
/// conversation the page sends "picture?VIEW", "reading?VIEW&x=&y=", "focus?VIEW&x=&y=" or "change?hogels=200"; it gets
/// texts, JSON objects whose `type` is state, reading, focus or error, and pictures: a line of JSON about the picture,
/// a line feed, and the file. POST /drop?name=bunny.ply brings a file, which is opened; with &more=yes it lies beside
/// the next one.
class Viewer final : public Site, public std::enable_shared_from_this<Viewer> {
  public:
    explicit Viewer(Access access);
    ~Viewer() override;

    /// Who changes what is looked at; null: nobody (any more).
    void set_controller(Controller* changes);
    /// Shows a subject from now on, in place of another.
    void show(std::shared_ptr<Viewable> viewable);
    /// Facts beside those of the subject, as members of one object: what it is called, the commands that repeat it.
    void describe(nlohmann::ordered_json facts);
    /// Tells every page what went wrong. @param parameter  names of Error::parameter()
    void complain(const std::string& message, const std::vector<std::string>& parameter);
    /// Says how far the work on the next one is: "rendering", 0 to 1. An empty text: it is done.
    void say(const std::string& what, double fraction);

    /// Whether a page is open or an answer is being made: work for all of them stops where nobody waits any more.
    bool is_watched() const;

    bool trusts(const Request& request) const override;
    std::function<void()> answer(const Request& request, std::function<void(Response)> reply) override;
    Response admit(const Request& request) override;
    std::variant<std::filesystem::path, Response> destination_for(const Request& request) override;
    Response take(const Request& request, const std::filesystem::path& file) override;
    std::shared_ptr<Conversation> open(std::weak_ptr<Socket> socket) override;

  private:
    class Session;

    std::shared_ptr<Viewable> viewable() const;
    std::string state() const;
    void tell(const std::string& text);
    std::string refusal(const Request& request) const;
    std::optional<Response> answer_without_viewable(const Request& request) const;
    std::function<void()> answer_about(const Request& request, const std::function<void(Response)>& reply);
    std::function<void()> put(Worker& worker, std::function<void(std::stop_token)> work);
    void forget(std::uint64_t client);

    Access access_;
    mutable std::mutex mutex_;
    Controller* controller_ = nullptr;
    nlohmann::ordered_json description_;
    std::size_t generation_ = 0;  // of the subjects that were shown
    std::shared_ptr<Viewable> viewable_;
    std::string what_ = "opening";
    double fraction_ = 0;
    std::map<std::uint64_t, std::weak_ptr<Socket>> sockets_;
    std::set<std::uint64_t> asking_;  // clients whose answer is being made
    std::atomic<std::uint64_t> clients_ = 0;
    // Last, so that their threads end before what they use. Waves are slow, and rays and readings do not wait for them.
    Worker rays_, waves_;
};

}  // namespace hogel::view
