// SPDX-License-Identifier: Apache-2.0
// The only file that includes EGL and OpenGL.
#include <fmt/format.h>

#include "bench/peers/renderers.h"
#include "hogel/error.h"

#ifndef HOGEL_EGL

namespace hogel::bench {

std::unique_ptr<RenderPeer> make_llvmpipe_peer(const ShadedScene&, const LightFieldGrid&, std::size_t) {
    throw Error(ErrorCode::not_built_in, "built without EGL and OpenGL (see the section [peers] of packages.txt)");
}

}  // namespace hogel::bench

#else

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <thread>

#include "hogel/work/parallel.h"

namespace hogel::bench {
namespace {

[[noreturn]] void fail(const std::string& what) { throw Error(ErrorCode::not_built_in, what); }

// OpenGL functions, found at run time.
struct OpenGl {
#define HOGEL_GL_FUNCTION(type, name) type name = reinterpret_cast<type>(eglGetProcAddress("gl" #name))
    HOGEL_GL_FUNCTION(PFNGLATTACHSHADERPROC, AttachShader);
    HOGEL_GL_FUNCTION(PFNGLBINDBUFFERPROC, BindBuffer);
    HOGEL_GL_FUNCTION(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer);
    HOGEL_GL_FUNCTION(PFNGLBINDTEXTUREPROC, BindTexture);
    HOGEL_GL_FUNCTION(PFNGLBINDVERTEXARRAYPROC, BindVertexArray);
    HOGEL_GL_FUNCTION(PFNGLBUFFERDATAPROC, BufferData);
    HOGEL_GL_FUNCTION(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus);
    HOGEL_GL_FUNCTION(PFNGLCLEARPROC, Clear);
    HOGEL_GL_FUNCTION(PFNGLCLEARCOLORPROC, ClearColor);
    HOGEL_GL_FUNCTION(PFNGLCOMPILESHADERPROC, CompileShader);
    HOGEL_GL_FUNCTION(PFNGLCREATEPROGRAMPROC, CreateProgram);
    HOGEL_GL_FUNCTION(PFNGLCREATESHADERPROC, CreateShader);
    HOGEL_GL_FUNCTION(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced);
    HOGEL_GL_FUNCTION(PFNGLENABLEPROC, Enable);
    HOGEL_GL_FUNCTION(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray);
    HOGEL_GL_FUNCTION(PFNGLFRAMEBUFFERTEXTUREPROC, FramebufferTexture);
    HOGEL_GL_FUNCTION(PFNGLGENBUFFERSPROC, GenBuffers);
    HOGEL_GL_FUNCTION(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers);
    HOGEL_GL_FUNCTION(PFNGLGENTEXTURESPROC, GenTextures);
    HOGEL_GL_FUNCTION(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays);
    HOGEL_GL_FUNCTION(PFNGLGETERRORPROC, GetError);
    HOGEL_GL_FUNCTION(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog);
    HOGEL_GL_FUNCTION(PFNGLGETPROGRAMIVPROC, GetProgramiv);
    HOGEL_GL_FUNCTION(PFNGLGETSTRINGPROC, GetString);
    HOGEL_GL_FUNCTION(PFNGLGETTEXIMAGEPROC, GetTexImage);
    HOGEL_GL_FUNCTION(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation);
    HOGEL_GL_FUNCTION(PFNGLLINKPROGRAMPROC, LinkProgram);
    HOGEL_GL_FUNCTION(PFNGLSHADERSOURCEPROC, ShaderSource);
    HOGEL_GL_FUNCTION(PFNGLTEXIMAGE3DPROC, TexImage3D);
    HOGEL_GL_FUNCTION(PFNGLUNIFORM2FVPROC, Uniform2fv);
    HOGEL_GL_FUNCTION(PFNGLUNIFORM4FPROC, Uniform4f);
    HOGEL_GL_FUNCTION(PFNGLUSEPROGRAMPROC, UseProgram);
    HOGEL_GL_FUNCTION(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer);
    HOGEL_GL_FUNCTION(PFNGLVIEWPORTPROC, Viewport);
#undef HOGEL_GL_FUNCTION
};

// A hogel is a camera with its axis along the hologram's normal: the picture's columns are U, its rows −V.
constexpr const char* vertex_shader = R"(#version 330
#extension GL_ARB_shader_viewport_layer_array : enable
#extension GL_AMD_vertex_shader_layer : enable
layout(location = 0) in vec3 position;  // x, y, depth
layout(location = 1) in vec3 radiance;
uniform vec2 hogels[VIEWS];
uniform vec4 directions;  // half widths of the view, its middle
uniform vec4 depths;      // clip z = depth * depths.x + depths.y
out vec3 colour;
void main() {
    float depth = position.z;
    vec2 along = (position.xy - hogels[gl_InstanceID] - directions.zw * depth) / directions.xy;
    gl_Position = vec4(along.x, -along.y, depth * depths.x + depths.y, depth);
    LAYER
    colour = radiance;
})";

constexpr const char* fragment_shader = R"(#version 330
in vec3 colour;
out vec4 seen;
void main() { seen = vec4(colour, 1); })";

void replace(std::string& text, const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
}

// Geometry that every context draws. Positions are in widths of the hologram.
struct Geometry {
    std::vector<float> vertices;  // position and radiance
    std::vector<std::uint32_t> indices;
    Rgb background;
    double scale, min_depth, max_depth;
};

Geometry geometry_of(const ShadedScene& scene, const LightFieldGrid& grid) {
    Geometry geometry{{}, {}, scene.background, 1 / (grid.pitch * static_cast<double>(grid.hogels_s)), 1e300, 0};
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Vec3 p = geometry.scale * scene.positions[i];
        const Rgb colour = scene.radiance[i];
        for (const double x : {p.x, p.y, -p.z}) geometry.vertices.push_back(static_cast<float>(x));
        for (const float x : {colour.r, colour.g, colour.b}) geometry.vertices.push_back(x);
        geometry.min_depth = std::min(geometry.min_depth, -p.z);
        geometry.max_depth = std::max(geometry.max_depth, -p.z);
    }
    if (!(geometry.min_depth > 0)) fail("its scene must lie behind the hologram");
    for (const ShadedScene::Triangle& triangle : scene.triangles)
        geometry.indices.insert(geometry.indices.end(), triangle.vertices.begin(), triangle.vertices.end());
    return geometry;
}

class Context {
  public:
    Context(EGLDisplay display, const Geometry& geometry, const LightFieldGrid& grid, std::size_t views)
        : display_(display), geometry_(geometry), grid_(grid), views_(views) {
        const std::array config_wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint configs = 0;
        eglBindAPI(EGL_OPENGL_API);
        eglChooseConfig(display, config_wanted.data(), &config, 1, &configs);
        const std::array wanted{
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display, configs > 0 ? config : nullptr, EGL_NO_CONTEXT, wanted.data());
        if (context_ == EGL_NO_CONTEXT) fail("no context of OpenGL 3.3");
    }
    ~Context() { eglDestroyContext(display_, context_); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // Must be called once, on the thread that will draw.
    void prepare() {
        make_current();
        const auto* renderer = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
        if (!renderer || !std::strstr(renderer, "llvmpipe"))
            fail(fmt::format("OpenGL is '{}', not llvmpipe", renderer ? renderer : ""));
        make_program();
        load_geometry();
        make_layers();
        gl_.Enable(GL_DEPTH_TEST);
        gl_.ClearColor(geometry_.background.r, geometry_.background.g, geometry_.background.b, 1);
        gl_.Viewport(0, 0, static_cast<GLsizei>(grid_.directions_u), static_cast<GLsizei>(grid_.directions_v));
        if (gl_.GetError() != GL_NO_ERROR) fail("OpenGL does not take the scene");
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    // Writes the samples of up to `views` hogels: red, green, blue and an unused byte each.
    void render(std::span<const HogelIndex> hogels, unsigned char* bytes) {
        std::vector<float> positions;
        for (const HogelIndex& hogel : hogels) {
            positions.push_back(static_cast<float>(geometry_.scale * grid_.s(static_cast<double>(hogel.s))));
            positions.push_back(static_cast<float>(geometry_.scale * grid_.t(static_cast<double>(hogel.t))));
        }
        gl_.Uniform2fv(hogels_, static_cast<GLsizei>(hogels.size()), positions.data());
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(geometry_.indices.size()), GL_UNSIGNED_INT,
                                  nullptr, static_cast<GLsizei>(hogels.size()));
        if (hogels.size() == views_) {
            gl_.GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
        } else {
            rest_.resize(views_ * grid_.directions() * 4);
            gl_.GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_UNSIGNED_BYTE, rest_.data());
            std::copy_n(rest_.data(), hogels.size() * grid_.directions() * 4, bytes);
        }
    }

    void make_current() {
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) fail("EGL has no context");
    }
    void release() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  private:
    void make_program() {
        std::string vertex = vertex_shader;
        replace(vertex, "VIEWS", std::to_string(views_));
        replace(vertex, "LAYER", views_ > 1 ? "gl_Layer = gl_InstanceID;" : "");
        const GLuint program = gl_.CreateProgram();
        for (const auto& [kind, source] :
             {std::pair{GL_VERTEX_SHADER, vertex.c_str()}, std::pair{GL_FRAGMENT_SHADER, fragment_shader}}) {
            const GLuint shader = gl_.CreateShader(static_cast<GLenum>(kind));
            gl_.ShaderSource(shader, 1, &source, nullptr);
            gl_.CompileShader(shader);
            gl_.AttachShader(program, shader);
        }
        gl_.LinkProgram(program);
        GLint linked = 0;
        gl_.GetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked) {
            std::array<char, 200> log{};
            gl_.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
            std::ranges::replace(log, '\n', ' ');
            fail(fmt::format("OpenGL does not take a shader: {}", log.data()));
        }
        gl_.UseProgram(program);
        hogels_ = gl_.GetUniformLocation(program, "hogels");
        gl_.Uniform4f(gl_.GetUniformLocation(program, "directions"), static_cast<float>(grid_.half_u()),
                      static_cast<float>(grid_.half_v()), static_cast<float>(grid_.center_u()),
                      static_cast<float>(grid_.center_v()));
        // Clip depths run from −1 at the nearest vertex to 1 at the farthest, after the division by w.
        const double near = 0.99 * geometry_.min_depth, far = 1.01 * geometry_.max_depth;
        gl_.Uniform4f(gl_.GetUniformLocation(program, "depths"), static_cast<float>((far + near) / (far - near)),
                      static_cast<float>(-2 * far * near / (far - near)), 0, 0);
    }

    void load_geometry() {
        GLuint array = 0;
        std::array<GLuint, 2> buffers{};
        gl_.GenVertexArrays(1, &array);
        gl_.BindVertexArray(array);
        gl_.GenBuffers(2, buffers.data());
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(geometry_.vertices.size() * sizeof(float)),
                       geometry_.vertices.data(), GL_STATIC_DRAW);
        gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                       static_cast<GLsizeiptr>(geometry_.indices.size() * sizeof(std::uint32_t)),
                       geometry_.indices.data(), GL_STATIC_DRAW);
        constexpr GLsizei stride = 6 * sizeof(float);
        gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
        // OpenGL takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
        gl_.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(3 * sizeof(float)));
        gl_.EnableVertexAttribArray(0);
        gl_.EnableVertexAttribArray(1);
    }

    // Makes a layer of colours and one of depths for each view. The colours stay bound for reading.
    void make_layers() {
        GLuint frame = 0;
        std::array<GLuint, 2> layers{};
        gl_.GenFramebuffers(1, &frame);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, frame);
        gl_.GenTextures(2, layers.data());
        const auto width = static_cast<GLsizei>(grid_.directions_u), height = static_cast<GLsizei>(grid_.directions_v);
        const auto depth = static_cast<GLsizei>(views_);
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, layers[1]);
        gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, width, height, depth, 0, GL_DEPTH_COMPONENT,
                       GL_FLOAT, nullptr);
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, layers[0]);
        gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA8, width, height, depth, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl_.FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layers[0], 0);
        gl_.FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layers[1], 0);
        if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            fail(fmt::format("OpenGL has no room for {} views", views_));
    }

    OpenGl gl_;
    EGLDisplay display_;
    const Geometry& geometry_;
    LightFieldGrid grid_;
    std::size_t views_;
    EGLContext context_ = EGL_NO_CONTEXT;
    GLint hogels_ = 0;
    std::vector<unsigned char> rest_;
};

class LlvmpipePeer final : public RenderPeer {
  public:
    LlvmpipePeer(const ShadedScene& scene, const LightFieldGrid& grid, std::size_t views)
        : grid_(grid), views_(views), geometry_(geometry_of(scene, grid)), display_(open_display()) {
        for (std::size_t i = 0; i < thread_count(); ++i)
            contexts_.push_back(std::make_unique<Context>(display_, geometry_, grid, views));
        on_all_threads([](Context& context, std::size_t) { context.prepare(); });
    }

    std::size_t min_hogels() const override { return views_ * contexts_.size(); }

    void render(std::span<const HogelIndex> hogels) override {
        bytes_.resize(hogels.size() * grid_.directions() * 4);
        on_all_threads([&](Context& context, std::size_t thread) {
            context.make_current();
            for (std::size_t first = thread * views_; first < hogels.size(); first += contexts_.size() * views_)
                context.render(hogels.subspan(first, std::min(views_, hogels.size() - first)),
                               bytes_.data() + first * grid_.directions() * 4);
            context.release();
        });
    }

    Rgb sample(std::size_t i, std::size_t v, std::size_t u) const override {
        const unsigned char* pixel = bytes_.data() + 4 * (i * grid_.directions() + v * grid_.directions_u + u);
        return {static_cast<float>(pixel[0]) / 255, static_cast<float>(pixel[1]) / 255,
                static_cast<float>(pixel[2]) / 255};
    }
    float rounding() const override { return 1.0f / 255; }
    float max_radiance() const override { return 1; }

  private:
    // Opens the display once, when Mesa reads these variables. A context sets up its triangles on the drawing thread.
    // So each thread has its own context, which also rasterises on that thread (LP_NUM_THREADS=0).
    static EGLDisplay open_display() {
        static const EGLDisplay display = [] {
            setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
            setenv("GALLIUM_DRIVER", "llvmpipe", 1);
            setenv("LP_NUM_THREADS", "0", 1);
            EGLDisplay opened = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
            if (opened == EGL_NO_DISPLAY || !eglInitialize(opened, nullptr, nullptr)) fail("no display of Mesa's");
            return opened;
        }();
        return display;
    }

    template <class Work>
    void on_all_threads(const Work& work) {
        std::vector<std::exception_ptr> failures(contexts_.size());
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < contexts_.size(); ++i)
            threads.emplace_back([&, i] {
                try {
                    work(*contexts_[i], i);
                } catch (...) {
                    failures[i] = std::current_exception();
                }
            });
        for (std::thread& thread : threads) thread.join();
        for (const std::exception_ptr& failure : failures)
            if (failure) std::rethrow_exception(failure);
    }

    LightFieldGrid grid_;
    std::size_t views_;
    Geometry geometry_;
    EGLDisplay display_;
    std::vector<std::unique_ptr<Context> > contexts_;
    std::vector<unsigned char> bytes_;  // [hogel][v][u][rgba]
};

}  // namespace

std::unique_ptr<RenderPeer> make_llvmpipe_peer(const ShadedScene& scene, const LightFieldGrid& grid,
                                               std::size_t views) {
    return std::make_unique<LlvmpipePeer>(scene, grid, views);
}

}  // namespace hogel::bench

#endif
