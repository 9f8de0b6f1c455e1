// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/picture_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/plot/rsvg_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

struct Release {
  void operator()(GInputStream* stream) const { rsvg().object_unref(stream); }
  void operator()(RsvgHandle* handle) const { rsvg().object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { rsvg().surface_destroy(surface); }
  void operator()(cairo_t* context) const { rsvg().context_destroy(context); }
  void operator()(GError* error) const { rsvg().error_free(error); }
};
template <class T> using Owned = std::unique_ptr<T, Release>;

std::string ending_of(const fs::path& path) {
  auto ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return ending;
}

[[noreturn]] void fail(GError* error) {
  const Owned<GError> owned(error);
  throw std::runtime_error(
      fmt::format("the picture cannot be drawn ({})", owned ? owned->message : "librsvg gives no reason"));
}

Owned<RsvgHandle> read_svg(const std::string& svg) {
  const Owned<GInputStream> stream(
      rsvg().memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr));
  GError* error = nullptr;
  // Unlimited: texts of many megabytes are taken too.
  Owned<RsvgHandle> handle(
      rsvg().handle_new_from_stream_sync(stream.get(), nullptr, RSVG_HANDLE_FLAG_UNLIMITED, nullptr, &error));
  if (!handle)
    fail(error);
  return handle;
}

Owned<cairo_surface_t> drawn_picture(RsvgHandle* handle) {
  gdouble width = 0;
  gdouble height = 0;
  rsvg().handle_get_intrinsic_size_in_pixels(handle, &width, &height);
  Owned<cairo_surface_t> surface(
      rsvg().image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)));
  const Owned<cairo_t> context(rsvg().context_create(surface.get()));
  const RsvgRectangle whole{0, 0, width, height};
  GError* error = nullptr;
  if (!rsvg().handle_render_document(handle, context.get(), &whole, &error))
    fail(error);
  return surface;
}

void write_svg(const fs::path& path, const std::string& svg) {
  std::ofstream stream(path, std::ios::binary);
  stream << svg;
  finish_writing(stream, path);
}

void write_png(const fs::path& path, const std::string& svg) {
  const auto handle = read_svg(svg);
  const auto surface = drawn_picture(handle.get());
  errno = 0;
  if (rsvg().surface_write_to_png(surface.get(), path.c_str()) != CAIRO_STATUS_SUCCESS)
    throw WriteError(path, errno);
}

} // namespace

void require_picture_name(const fs::path& path) {
  const auto ending = ending_of(path);
  if (ending != ".svg" && ending != ".png")
    throw InputError(fmt::format("{}: found the ending '{}', expected .svg or .png", path.string(),
                                 path.extension().string()));
}

void write_picture(const fs::path& path, const std::string& svg) {
  require_picture_name(path);
  const auto folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder) || fs::is_directory(path))
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(),
                                 fs::is_directory(path) ? "it is a folder" : "there is no such folder"));
  write_whole(path, [&](const fs::path& beside) {
    ending_of(path) == ".png" ? write_png(beside, svg) : write_svg(beside, svg);
  });
}

} // namespace rubato::plot
