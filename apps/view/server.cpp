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

constexpr std::size_t max_texts = 64;  // queued on a socket before it is closed

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

Request request_of(const HttpRequest& http_request) {
    const std::string target = text_of(http_request.target());
    const std::size_t query = std::min(target.find('?'), target.size());
    return {text_of(http_request.method_string()),
            target.substr(0, query),
            query < target.size() ? target.substr(query + 1) : "",
            text_of(http_request[http::field::host]),
            text_of(http_request[http::field::origin]),
            text_of(http_request["Sec-Fetch-Site"])};
}

// Headers of all responses: no caching, no embedding, and no resources from other origins.
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
                std::shared_ptr<void> connection_count)
        : socket_(std::move(stream)), request_(std::move(request)), connection_count_(std::move(connection_count)) {
        beast::get_lowest_layer(socket_).expires_never();
        websocket::stream_base::timeout timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
        timeout.idle_timeout = std::chrono::seconds(limits.idle_seconds);  // with pings: keeps silent pages open
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
            outgoing_ = std::move(*picture_);
            picture_.reset();
        } else if (!texts_.empty()) {
            outgoing_ = std::move(texts_.front());
            texts_.pop_front();
        } else {
            return;
        }
        writing_ = true;
        socket_.binary(picture);
        socket_.async_write(asio::buffer(outgoing_), [self = shared_from_this(), picture](Code error, std::size_t) {
            self->writing_ = false;
            if (error) return self->end();
            if (picture && --self->unsent_ == 1 && self->conversation_) self->conversation_->resume();
            self->write();
        });
    }

    void close() { beast::get_lowest_layer(socket_).close(); }

    // The conversation refers to this socket: destroy it first.
    void end() {
        ended_ = true;
        conversation_.reset();
    }

    websocket::stream<beast::tcp_stream> socket_;
    HttpRequest request_;
    std::shared_ptr<void> connection_count_;
    std::shared_ptr<Conversation> conversation_;
    beast::flat_buffer buffer_;
    std::deque<std::string> texts_;
    std::optional<std::string> picture_;
    std::string outgoing_;
    std::atomic<int> unsent_ = 0;
    bool writing_ = false, ended_ = false;
};

class Connection;

// State shared by all connections. Used only on the server's thread.
struct Shared {
    ServerLimits limits;
    Site* site = nullptr;
    std::size_t open = 0;                            // number of connections and sockets
    std::list<std::weak_ptr<Connection>> evictable;  // no trusted request yet; oldest first
};

// Counts a connection while the returned pointer lives.
std::shared_ptr<void> count_connection(const std::shared_ptr<Shared>& shared) {
    ++shared->open;
    return {nullptr, [shared](void*) { --shared->open; }};
}

class Connection final : public std::enable_shared_from_this<Connection> {
  public:
    Connection(tcp::socket socket, std::shared_ptr<Shared> shared)
        : stream_(std::move(socket)), shared_(std::move(shared)), connection_count_(count_connection(shared_)) {}
    ~Connection() { protect(); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void read(int seconds) {
        parser_.emplace();
        parser_->header_limit(static_cast<std::uint32_t>(shared_->limits.header));
        parser_->body_limit(shared_->limits.body);
        protect();
        eviction_position_ = shared_->evictable.insert(shared_->evictable.end(), weak_from_this());
        stream_.expires_after(std::chrono::seconds(seconds));
        http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](Code error, std::size_t) {
            if (error) return self->received(error);
            if (self->parser_->get().method() == http::verb::post) return self->read_file();
            self->read_nothing();
        });
    }

    void close() {
        protect();
        stream_.close();
        connection_count_.reset();  // a pending answer may keep this object alive
    }

  private:
    // Excludes this connection from eviction.
    void protect() {
        if (eviction_position_) shared_->evictable.erase(*eviction_position_);
        eviction_position_.reset();
    }

    // Completes a request without a body; a body is an error.
    void read_nothing() {
        http::async_read(stream_, buffer_, *parser_,
                         [self = shared_from_this()](Code error, std::size_t) { self->received(error); });
    }

    // Writes the body of a POST to a file, if the site accepts it.
    void read_file() {
        const Request request = request_of(parser_->get());
        auto destination = shared_->site->destination_for(request);
        if (std::holds_alternative<Response>(destination)) return respond(std::get<Response>(destination), false);
        protect();
        const auto file = std::get<std::filesystem::path>(destination);
        auto body = std::make_shared<http::request_parser<http::file_body>>(std::move(*parser_));
        body->body_limit(shared_->limits.body);
        Code error;
        body->get().body().open(file.c_str(), beast::file_mode::write, error);
        if (error)
            return respond({500, "text/plain; charset=utf-8", "the file cannot be written: " + error.message() + "\n"},
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
            // Answer malformed HTTP, but not closed or slow connections.
            if (error.category() == http::make_error_code(http::error::bad_method).category() &&
                error != http::error::end_of_stream && error != http::error::partial_message)
                respond({400, "text/plain; charset=utf-8", "expected an HTTP/1.1 request without a body\n"}, false);
            return;
        }
        HttpRequest http_request = parser_->release();
        const Request request = request_of(http_request);
        if (shared_->site->trusts(request)) protect();
        if (websocket::is_upgrade(http_request)) {
            const Response admission = shared_->site->admit(request);
            if (admission.status != 101) return respond(admission, false);
            std::make_shared<BeastSocket>(std::move(stream_), std::move(http_request), shared_->limits,
                                          std::move(connection_count_))
                ->open(*shared_->site);
            return;
        }
        stream_.expires_never();  // while the answer is computed
        const bool keep_alive = http_request.keep_alive();
        cancel_ = shared_->site->answer(request, [self = shared_from_this(), keep_alive](Response response) {
            asio::post(self->stream_.get_executor(), [self, keep_alive, response = std::move(response)]() mutable {
                self->cancel_ = nullptr;
                self->respond(std::move(response), keep_alive);
            });
        });
        if (cancel_) watch();
    }

    // Cancels the answer if the client closes the connection. Stops watching a client that sends more data before it
    // has the answer.
    void watch() {
        stream_.socket().async_wait(tcp::socket::wait_read, [watched = weak_from_this()](Code) {
            const auto self = watched.lock();
            if (!self || !self->cancel_) return;
            Code error;
            if (self->stream_.socket().available(error) > 0) return;
            std::exchange(self->cancel_, nullptr)();
            self->close();
        });
    }

    void respond(Response response, bool keep_alive) {
        auto message = std::make_shared<http::response<http::string_body>>();
        message->version(11);
        message->result(response.status);
        add_headers(*message, response.type);
        message->keep_alive(keep_alive);
        message->body() = std::move(response.body);
        message->prepare_payload();
        stream_.expires_after(std::chrono::seconds(shared_->limits.idle_seconds));
        http::async_write(stream_, *message, [self = shared_from_this(), message, keep_alive](Code error, std::size_t) {
            if (!error && keep_alive) return self->read(self->shared_->limits.idle_seconds);
            Code none;
            self->stream_.socket().shutdown(tcp::socket::shutdown_send, none);
        });
    }

    beast::tcp_stream stream_;
    std::shared_ptr<Shared> shared_;
    std::shared_ptr<void> connection_count_;
    beast::flat_buffer buffer_{65536};
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::optional<std::list<std::weak_ptr<Connection>>::iterator> eviction_position_;  // in Shared::evictable
    std::function<void()> cancel_;                                                     // cancels the answer
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
            start_connection(std::move(socket));
            accept();
        });
    }

    // After errors such as no free file descriptor.
    void accept_later() {
        pause.expires_after(std::chrono::milliseconds(100));
        pause.async_wait([this](Code error) {
            if (!error) accept();
        });
    }

    void start_connection(tcp::socket socket) {
        if (shared->open >= shared->limits.connections) {
            const auto oldest = shared->evictable.empty() ? nullptr : shared->evictable.front().lock();
            if (!oldest) return;  // all connections are trusted: refuse the new one
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
        throw Error(ErrorCode::usage, "host",
                    fmt::format("{} is not an IP address such as 127.0.0.1 or 192.168.1.5", host));
    const tcp::endpoint endpoint(address, port);
    tcp::acceptor& acceptor = impl_->acceptor;
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        throw Error(
            ErrorCode::usage,
            fmt::format("{} {}: cannot listen: {}; choose another --port, or --port 0 for a free one",
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
