#include "render/geometry_pass.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>

#include "render/gl_context.h"
#include "render/shaders.h"

namespace sunlit::render {
namespace {

struct Vertex {
  Eigen::Vector3f position, normal;
  Eigen::Vector2f texture_coordinate;
  Eigen::Vector3f color;
};

void attribute(GLuint index, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offset));
}

enum VariantBit { kTextured = 1, kMasked = 2 };

int variantOf(const scene::Material& material) {
  const bool textured = material.base_texture != scene::Material::kNoTexture;
  const bool masked = textured && material.alpha_mode == scene::AlphaMode::kMask;
  return (textured ? kTextured : 0) | (masked ? kMasked : 0);
}

std::string definitions(int variant) {
  return std::string(variant & kTextured ? "#define TEXTURED\n" : "") +
         (variant & kMasked ? "#define MASKED\n" : "");
}

}  // namespace

/// One combination of what materials need, and where its uniforms are.
struct GeometryPass::Variant {
  explicit Variant(int bits)
      : program(definitions(bits), kVertexShader, kFragmentShader),
        optical_from_map(program.uniform("optical_from_map")),
        eye_high(program.uniform("eye_high")),
        eye_low(program.uniform("eye_low")),
        projection(program.uniform("projection")),
        depth_range(program.uniform("depth_range")),
        base_color(program.uniform("base_color")),
        alpha_cutoff(program.uniform("alpha_cutoff")),
        first_triangle(program.uniform("first_triangle")) {}

  GlProgram program;
  GLint optical_from_map, eye_high, eye_low, projection, depth_range, base_color, alpha_cutoff,
      first_triangle;
};

GeometryPass::GeometryPass(std::shared_ptr<const light::Geometry> geometry, const View& view, double lod_bias)
    : geometry_(std::move(geometry)),
      textures_(*geometry_->scene, lod_bias),
      clip_control_(reinterpret_cast<PFNGLCLIPCONTROLPROC>(GlContext::function("glClipControl"))) {
  uploadVertices();
  createTarget(view);
}

GeometryPass::~GeometryPass() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &color_);
  glDeleteRenderbuffers(1, &depth_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void GeometryPass::uploadVertices() {
  std::vector<Vertex> vertices(geometry_->positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = {geometry_->positions[i], geometry_->normals[i], geometry_->texture_coordinates[i],
                   geometry_->colors[i].matrix()};
  }
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STATIC_DRAW);
  attribute(0, 3, offsetof(Vertex, position));
  attribute(1, 3, offsetof(Vertex, normal));
  attribute(2, 2, offsetof(Vertex, texture_coordinate));
  attribute(3, 3, offsetof(Vertex, color));
  glGenBuffers(1, &indices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(geometry_->triangles.size() * sizeof(geometry_->triangles[0])),
               geometry_->triangles.data(), GL_STATIC_DRAW);
}

void GeometryPass::createTarget(const View& view) {
  const int width = view.camera.width * view.supersampling;
  const int height = view.camera.height * view.supersampling;
  glGenRenderbuffers(1, &color_);
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32UI, width, height);
  glGenRenderbuffers(1, &depth_);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("OpenGL cannot make a geometry buffer of " + std::to_string(width) + "x" +
                             std::to_string(height) + " samples");
  }
}

std::vector<const light::Chunk*> GeometryPass::visibleChunks(const View& view) const {
  const Frustum frustum(view);
  const Eigen::Vector3f eye = view.eye().cast<float>();
  std::vector<std::pair<float, const light::Chunk*>> near_first;
  for (const light::Chunk& chunk : geometry_->chunks) {
    if (frustum.touches(chunk.box)) near_first.emplace_back(chunk.box.squaredExteriorDistance(eye), &chunk);
  }
  // What is near hides what is far, before its pixels are computed.
  std::stable_sort(near_first.begin(), near_first.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const light::Chunk*> chunks;
  chunks.reserve(near_first.size());
  for (const auto& entry : near_first) chunks.push_back(entry.second);
  return chunks;
}

const GeometryPass::Variant& GeometryPass::variant(const scene::Material& material) {
  auto& entry = variants_[variantOf(material)];
  if (!entry) entry = std::make_unique<Variant>(variantOf(material));
  return *entry;
}

void GeometryPass::setView(const Variant& variant, const View& view) const {
  const Eigen::Matrix3f optical_from_map = view.map_from_optical.linear().transpose().cast<float>();
  glUniformMatrix3fv(variant.optical_from_map, 1, GL_FALSE, optical_from_map.data());
  const Eigen::Vector3f high = view.eye().cast<float>();
  const Eigen::Vector3f low = (view.eye() - high.cast<double>()).cast<float>();
  glUniform3fv(variant.eye_high, 1, high.data());
  glUniform3fv(variant.eye_low, 1, low.data());
  // GL counts from the edge of a pixel, the camera from its centre. Row 0 of the buffer is the top one: GL's
  // y points down here, like the camera's.
  const image::PinholeCamera& c = view.camera;
  glUniform4f(variant.projection, static_cast<float>(2.0 * c.fx / c.width),
              static_cast<float>(2.0 * c.fy / c.height),
              static_cast<float>((2.0 * c.cx + 1.0) / c.width - 1.0),
              static_cast<float>((2.0 * c.cy + 1.0) / c.height - 1.0));
  glUniform2f(variant.depth_range, static_cast<float>(view.near_m), static_cast<float>(view.far_m));
}

void GeometryPass::setMaterial(const Variant& variant, const scene::Material& material) const {
  textures_.bind(material.base_texture);
  glUniform3fv(variant.base_color, 1, material.base_color.value.data());
  glUniform1f(variant.alpha_cutoff, material.alpha_cutoff);
  if (material.double_sided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

void GeometryPass::draw(const View& view, std::vector<PackedSample>* samples) {
  const int width = view.camera.width * view.supersampling;
  const int height = view.camera.height * view.supersampling;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glBindVertexArray(vertex_array_);
  glViewport(0, 0, width, height);
  clip_control_(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glFrontFace(GL_CW);  // the picture is upside down for GL, so that faces seem to turn the other way
  const GLuint sky[4] = {0, PackedSample::kNoNormal, 0, 0};
  const GLfloat far = 0.0f;
  glClearBufferuiv(GL_COLOR, 0, sky);
  glClearBufferfv(GL_DEPTH, 0, &far);

  std::set<const Variant*> ready;
  int material_in_use = -1;
  const Variant* in_use = nullptr;
  for (const light::Chunk* chunk : visibleChunks(view)) {
    const scene::Material& material = geometry_->scene->materials[static_cast<std::size_t>(chunk->material)];
    if (chunk->material != material_in_use) {
      const Variant& wanted = variant(material);
      wanted.program.use();
      if (ready.insert(&wanted).second) setView(wanted, view);
      setMaterial(wanted, material);
      material_in_use = chunk->material;
      in_use = &wanted;
    }
    glUniform1ui(in_use->first_triangle, chunk->first + 1);
    glDrawElements(
        GL_TRIANGLES, static_cast<GLsizei>(3 * chunk->count), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(static_cast<std::size_t>(chunk->first) * 3 * sizeof(GLuint)));
  }
  samples->resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, samples->data());
}

}  // namespace sunlit::render
