// SPDX-License-Identifier: Apache-2.0
#include "view/server.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace hogel::view {
namespace {

// One connection to a server on this machine.
class Caller {
  public:
    explicit Caller(unsigned short port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        const timeval patience{30, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    ~Caller() { ::close(socket_); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    void send(const std::string& text) {
        EXPECT_EQ(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
    }
    /// The first line that comes; empty if the connection ends before.
    std::string line() {
        std::string got;
        char c = 0;
        while (::recv(socket_, &c, 1, 0) == 1 && c != '\r') got += c;
        return got;
    }

  private:
    int socket_;
};

// Trusts requests for "/own", which get no response, and for "/own/now", which get one.
class OwnSite final : public Site {
  public:
    bool trusts(const Request& request) const override { return request.path.starts_with("/own"); }
    std::function<void()> answer(const Request& request, std::function<void(Response)> reply) override {
        const unsigned status = trusts(request) ? 200 : 403;
        if (request.path == "/own") {
            const std::lock_guard lock(mutex_);
            replies_.push_back(std::move(reply));
            changed_.notify_all();
            return [this] {
                const std::lock_guard guard(mutex_);
                ++given_up_;
                changed_.notify_all();
            };
        }
        reply({status, "text/plain", request.path == "/large" ? std::string(8 << 20, 'x') : "x"});
        return {};
    }
    Response admit(const Request&) override { return {403, "text/plain", ""}; }
    std::variant<std::filesystem::path, Response> destination_for(const Request&) override {
        return Response{403, "text/plain", ""};
    }
    Response take(const Request&, const std::filesystem::path&) override { return {}; }
    std::shared_ptr<Conversation> open(std::weak_ptr<Socket>) override { return {}; }

    bool wait_for_asked(std::size_t count) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return replies_.size() >= count; });
    }
    bool wait_for_given_up(std::size_t count) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return given_up_ >= count; });
    }
    void reply_to_all() {
        const std::lock_guard lock(mutex_);
        for (const auto& reply : replies_) reply({200, "text/plain", "late"});
        replies_.clear();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::function<void(Response)>> replies_;
    std::size_t given_up_ = 0;
};

// Without timeouts, so that only eviction closes connections.
ServerLimits patient() {
    ServerLimits limits;
    limits.connections = 8;
    limits.header_seconds = limits.idle_seconds = 600;
    return limits;
}

struct Running {
    OwnSite site;
    Server server{"127.0.0.1", 0, patient()};
    std::jthread thread{[this](const std::stop_token& stop) { server.run(site, stop); }};

    std::vector<std::unique_ptr<Caller>> strangers(const std::string& opening) {
        std::vector<std::unique_ptr<Caller>> all;
        for (std::size_t i = 0; i < 2 * patient().connections; ++i) {
            all.push_back(std::make_unique<Caller>(server.port()));
            if (!opening.empty()) all.back()->send(opening);
        }
        return all;
    }
    std::string owner_gets() {
        Caller owner(server.port());
        owner.send("GET /own/now HTTP/1.1\r\nHost: a\r\n\r\n");
        return owner.line();
    }
};

TEST(Server, strangers_give_way_whatever_they_do) {
    Running running;
    const std::string refused = "GET /x HTTP/1.1\r\nHost: a\r\n\r\n";
    for (const std::string& opening : {std::string(), std::string("GET /x HT"),
                                       std::string("GET /x HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n"),
                                       std::string("POST /x HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n"),
                                       std::string("GET /own HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n"),
                                       refused, std::string("GET /large HTTP/1.1\r\nHost: a\r\n\r\n")}) {
        const auto strangers = running.strangers(opening);
        EXPECT_EQ(running.owner_gets(), "HTTP/1.1 200 OK") << opening;
    }
}

TEST(Server, keeps_an_answer_for_who_is_trusted) {
    Running running;
    Caller owner(running.server.port());
    owner.send("GET /own HTTP/1.1\r\nHost: a\r\n\r\n");
    ASSERT_TRUE(running.site.wait_for_asked(1));
    const auto strangers = running.strangers("GET /x HT");
    EXPECT_EQ(running.owner_gets(), "HTTP/1.1 200 OK");
    running.site.reply_to_all();
    EXPECT_EQ(owner.line(), "HTTP/1.1 200 OK");
}

TEST(Server, gives_up_an_answer_whose_asker_is_gone) {
    Running running;
    for (std::size_t i = 1; i <= 2 * patient().connections; ++i) {
        {
            Caller owner(running.server.port());
            owner.send("GET /own HTTP/1.1\r\nHost: a\r\n\r\n");
            ASSERT_TRUE(running.site.wait_for_asked(i));
        }
        ASSERT_TRUE(running.site.wait_for_given_up(i));
    }
    running.site.reply_to_all();
    EXPECT_EQ(running.owner_gets(), "HTTP/1.1 200 OK");
}

}  // namespace
}  // namespace hogel::view
