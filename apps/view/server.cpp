// SPDX-License-Identifier: Apache-2.0
#include "view/server.h"

#include <fmt/format.h>

#include <utility>  // before Asio, whose version in Boost 1.74 uses std::exchange() without it

#include <algorithm>
#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <list>
#include <optional>

#include "hogel/error.h"

namespace hogel::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Code = beast::error_code;
using HttpRequest = http::request<http::empty_body>;

constexpr std::size_t max_texts = 64;  // that wait on a socket whose other end does not read

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

Request request_of(const HttpRequest& from) {
    const std::string target = text_of(from.target());
    const std::size_t query = std::min(target.find('?'), target.size());
    return {text_of(from.method_string()),
            target.substr(0, query),
            query < target.size() ? target.substr(query + 1) : "",
            text_of(from[http::field::host]),
            text_of(from[http::field::origin]),
            text_of(from["Sec-Fetch-Site"])};
}

// What every answer says: nothing is kept, nothing may be embedded, and the page may use nothing from elsewhere.
template <class Message>
void add_headers(Message& message, const std::string& type) {
    message.set(http::field::content_type, type);
    message.set(http::field::cache_control, "no-store");
    message.set("X-Content-Type-Options", "nosniff");
    message.set("Cross-Origin-Resource-Policy", "same-origin");
    message.set("Cross-Origin-Opener-Policy", "same-origin");
    message.set("Referrer-Policy", "no-referrer");
    message.set("X-Frame-Options", "DENY");
    message.set("Content-Security-Policy",
                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
                "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
}

class BeastSocket final : public Socket, public std::enable_shared_from_this<BeastSocket> {
  public:
    BeastSocket(beast::tcp_stream stream, HttpRequest request, const ServerLimits& limits,
                std::shared_ptr<void> counted)
        : socket_(std::move(stream)), request_(std::move(request)), counted_(std::move(counted)) {
        beast::get_lowest_layer(socket_).expires_never();
        websocket::stream_base::timeout timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.idle_timeout = std::chrono::seconds(limits.idle_seconds);  // with pings, so that a silent page stays
        socket_.set_option(timeout);
        socket_.read_message_max(limits.message);
    }

    void open(Site& site) {
        socket_.async_accept(request_, [self = shared_from_this(), &site](Code error) {
            if (error) return;
            self->conversation_ = site.open(self->weak_from_this());
            self->read();
        });
    }

    void send_text(std::string text) override {
        asio::post(socket_.get_executor(), [self = shared_from_this(), text = std::move(text)]() mutable {
            if (self->texts_.size() >= max_texts) return self->close();
            self->texts_.push_back(std::move(text));
            self->write();
        });
    }

    void send_picture(std::string bytes) override {
        ++unsent_;
        asio::post(socket_.get_executor(), [self = shared_from_this(), bytes = std::move(bytes)]() mutable {
            if (self->picture_) --self->unsent_;
            self->picture_ = std::move(bytes);
            self->write();
        });
    }

    bool is_busy() const override { return unsent_ >= 2; }

  private:
    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](Code error, std::size_t) {
            if (error) return self->end();
            if (self->socket_.got_text() && self->conversation_) {
                const auto data = self->buffer_.data();
                self->conversation_->receive({static_cast<const char*>(data.data()), data.size()});
            }
            self->buffer_.consume(self->buffer_.size());
            self->read();
        });
    }

    void write() {
        if (writing_ || ended_) return;
        const bool picture = texts_.empty() && picture_;
        if (picture) {
            going_ = std::move(*picture_);
            picture_.reset();
        } else if (!texts_.empty()) {
            going_ = std::move(texts_.front());
            texts_.pop_front();
        } else {
            return;
        }
        writing_ = true;
        socket_.binary(picture);
        socket_.async_write(asio::buffer(going_), [self = shared_from_this(), picture](Code error, std::size_t) {
            self->writing_ = false;
            if (error) return self->end();
            if (picture && --self->unsent_ == 1 && self->conversation_) self->conversation_->resume();
            self->write();
        });
    }

    void close() { beast::get_lowest_layer(socket_).close(); }

    // The conversation knows this socket, so that it goes first.
    void end() {
        ended_ = true;
        conversation_.reset();
    }

    websocket::stream<beast::tcp_stream> socket_;
    HttpRequest request_;
    std::shared_ptr<void> counted_;
    std::shared_ptr<Conversation> conversation_;
    beast::flat_buffer buffer_;
    std::deque<std::string> texts_;
    std::optional<std::string> picture_;
    std::string going_;
    std::atomic<int> unsent_ = 0;
    bool writing_ = false, ended_ = false;
};

class Connection;

// What the connections share. Used on the server's thread alone.
struct Shared {
    ServerLimits limits;
    Site* site = nullptr;
    std::size_t open = 0;                             // connections and sockets
    std::list<std::weak_ptr<Connection>> expendable;  // without a whole request that the site trusts; oldest first
};

// Counts one connection for as long as it or its socket lives.
std::shared_ptr<void> count(const std::shared_ptr<Shared>& shared) {
    ++shared->open;
    return {nullptr, [shared](void*) { --shared->open; }};
}

class Connection final : public std::enable_shared_from_this<Connection> {
  public:
    Connection(tcp::socket socket, std::shared_ptr<Shared> shared)
        : stream_(std::move(socket)), shared_(std::move(shared)), counted_(count(shared_)) {}
    ~Connection() { keep(); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void read(int seconds) {
        parser_.emplace();
        parser_->header_limit(static_cast<std::uint32_t>(shared_->limits.header));
        parser_->body_limit(shared_->limits.body);
        keep();
        place_ = shared_->expendable.insert(shared_->expendable.end(), weak_from_this());
        stream_.expires_after(std::chrono::seconds(seconds));
        http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](Code error, std::size_t) {
            if (error) return self->received(error);
            if (self->parser_->get().method() == http::verb::post) return self->read_file();
            self->read_nothing();
        });
    }

    void close() {
        keep();
        stream_.close();
        counted_.reset();  // an answer that is still made may hold this object
    }

  private:
    // No longer gives way to a new connection.
    void keep() {
        if (place_) shared_->expendable.erase(*place_);
        place_.reset();
    }

    // What follows a header that announces no body; a body makes this an error.
    void read_nothing() {
        http::async_read(stream_, buffer_, *parser_,
                         [self = shared_from_this()](Code error, std::size_t) { self->received(error); });
    }

    // The body of a POST becomes a file, if the site has a place for it.
    void read_file() {
        const Request request = request_of(parser_->get());
        auto place = shared_->site->destination_for(request);
        if (std::holds_alternative<Response>(place)) return respond(std::get<Response>(place), false);
        keep();
        const auto file = std::get<std::filesystem::path>(place);
        auto body = std::make_shared<http::request_parser<http::file_body>>(std::move(*parser_));
        body->body_limit(shared_->limits.body);
        Code error;
        body->get().body().open(file.c_str(), beast::file_mode::write, error);
        if (error)
            return respond({500, "text/plain; charset=utf-8", "the file cannot be kept: " + error.message() + "\n"},
                           false);
        stream_.expires_after(std::chrono::seconds(shared_->limits.body_seconds));
        http::async_read(
            stream_, buffer_, *body, [self = shared_from_this(), body, request, file](Code failed, std::size_t) {
                body->get().body().close();
                if (!failed) return self->respond(self->shared_->site->take(request, file), true);
                std::error_code none;
                std::filesystem::remove(file, none);
                if (failed == http::error::body_limit)
                    self->respond({413, "text/plain; charset=utf-8", "the file is larger than --memory\n"}, false);
            });
    }

    void received(Code error) {
        if (error) {
            // What is no HTTP is told so; who has gone or is too slow is not.
            if (error.category() == http::make_error_code(http::error::bad_method).category() &&
                error != http::error::end_of_stream && error != http::error::partial_message)
                respond({400, "text/plain; charset=utf-8", "not a request without a body of HTTP/1.1\n"}, false);
            return;
        }
        HttpRequest from = parser_->release();
        const Request request = request_of(from);
        if (shared_->site->trusts(request)) keep();
        if (websocket::is_upgrade(from)) {
            const Response verdict = shared_->site->admit(request);
            if (verdict.status != 101) return respond(verdict, false);
            std::make_shared<BeastSocket>(std::move(stream_), std::move(from), shared_->limits, std::move(counted_))
                ->open(*shared_->site);
            return;
        }
        stream_.expires_never();  // while the answer is made
        const bool again = from.keep_alive();
        give_up_ = shared_->site->answer(request, [self = shared_from_this(), again](Response response) {
            asio::post(self->stream_.get_executor(), [self, again, response = std::move(response)]() mutable {
                self->give_up_ = nullptr;
                self->respond(std::move(response), again);
            });
        });
        if (give_up_) watch();
    }

    // Stops the work on an answer whose asker closes the connection. One that sends more before it has the answer is
    // not watched further.
    void watch() {
        stream_.socket().async_wait(tcp::socket::wait_read, [watched = weak_from_this()](Code) {
            const auto self = watched.lock();
            if (!self || !self->give_up_) return;
            Code error;
            if (self->stream_.socket().available(error) > 0) return;
            std::exchange(self->give_up_, nullptr)();
            self->close();
        });
    }

    void respond(Response response, bool again) {
        auto message = std::make_shared<http::response<http::string_body>>();
        message->version(11);
        message->result(response.status);
        add_headers(*message, response.type);
        message->keep_alive(again);
        message->body() = std::move(response.body);
        message->prepare_payload();
        stream_.expires_after(std::chrono::seconds(shared_->limits.idle_seconds));
        http::async_write(stream_, *message, [self = shared_from_this(), message, again](Code error, std::size_t) {
            if (!error && again) return self->read(self->shared_->limits.idle_seconds);
            Code none;
            self->stream_.socket().shutdown(tcp::socket::shutdown_send, none);
        });
    }

    beast::tcp_stream stream_;
    std::shared_ptr<Shared> shared_;
    std::shared_ptr<void> counted_;
    beast::flat_buffer buffer_{65536};
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::optional<std::list<std::weak_ptr<Connection>>::iterator> place_;  // among those that give way
    std::function<void()> give_up_;                                        // stops the work on the answer
};

}  // namespace

struct Server::Impl {
    std::shared_ptr<Shared> shared = std::make_shared<Shared>();
    asio::io_context context{1};
    tcp::acceptor acceptor{context};
    asio::steady_timer pause{context};

    void accept() {
        acceptor.async_accept([this](Code error, tcp::socket socket) {
            if (error == asio::error::operation_aborted) return;
            if (error) return accept_later();
            greet(std::move(socket));
            accept();
        });
    }

    // No file number is left, for instance.
    void accept_later() {
        pause.expires_after(std::chrono::milliseconds(100));
        pause.async_wait([this](Code error) {
            if (!error) accept();
        });
    }

    void greet(tcp::socket socket) {
        if (shared->open >= shared->limits.connections) {
            const auto oldest = shared->expendable.empty() ? nullptr : shared->expendable.front().lock();
            if (!oldest) return;  // all are at work for those who are trusted; this one is closed
            oldest->close();
        }
        Code none;
        socket.set_option(tcp::no_delay(true), none);
        std::make_shared<Connection>(std::move(socket), shared)->read(shared->limits.header_seconds);
    }
};

Server::Server(const std::string& host, unsigned short port, const ServerLimits& limits)
    : impl_(std::make_unique<Impl>()) {
    impl_->shared->limits = limits;
    Code error;
    const asio::ip::address address = asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
    if (error)
        throw Error(ErrorCode::usage, "host", fmt::format("{} is no address such as 127.0.0.1 or 192.168.1.5", host));
    const tcp::endpoint endpoint(address, port);
    tcp::acceptor& acceptor = impl_->acceptor;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        throw Error(
            ErrorCode::usage,
            fmt::format("{} {}: cannot listen there: {}; another --port would do, or --port 0 for a free one",
                        port == 0 ? "--host" : "--port", port == 0 ? host : std::to_string(port), error.message()));
}

Server::~Server() = default;

unsigned short Server::port() const { return impl_->acceptor.local_endpoint().port(); }

void Server::run(Site& site, const std::stop_token& stop) {
    impl_->shared->site = &site;
    impl_->accept();
    const std::stop_callback end(stop, [this] { impl_->context.stop(); });
    impl_->context.run();
}

}  // namespace hogel::view
