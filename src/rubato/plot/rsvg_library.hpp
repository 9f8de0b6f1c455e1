// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the functions of librsvg, and of cairo, GIO and GLib on which it depends. The
/// libraries are loaded at the first call, because PNG files alone need them and they depend on forty more.
#pragma once

#include "rubato/core/dynamic_library.hpp"

#include <librsvg/rsvg.h>

namespace rubato::plot {

/// The members are named after the functions, without the prefix of each library. A context is a cairo_t.
struct RsvgCalls {
  DynamicLibrary library;
  decltype(&rsvg_handle_new_from_stream_sync) handle_new_from_stream_sync =
      library.symbol("rsvg_handle_new_from_stream_sync");
  decltype(&rsvg_handle_get_intrinsic_size_in_pixels) handle_get_intrinsic_size_in_pixels =
      library.symbol("rsvg_handle_get_intrinsic_size_in_pixels");
  decltype(&rsvg_handle_render_document) handle_render_document =
      library.symbol("rsvg_handle_render_document");

  decltype(&cairo_image_surface_create) image_surface_create = library.symbol("cairo_image_surface_create");
  decltype(&cairo_surface_write_to_png) surface_write_to_png = library.symbol("cairo_surface_write_to_png");
  decltype(&cairo_surface_destroy) surface_destroy = library.symbol("cairo_surface_destroy");
  decltype(&cairo_create) context_create = library.symbol("cairo_create");
  decltype(&cairo_destroy) context_destroy = library.symbol("cairo_destroy");

  decltype(&g_memory_input_stream_new_from_data) memory_input_stream_new_from_data =
      library.symbol("g_memory_input_stream_new_from_data");
  decltype(&g_object_unref) object_unref = library.symbol("g_object_unref");
  decltype(&g_error_free) error_free = library.symbol("g_error_free");
};

/// Throws InputError when the library cannot be loaded.
const RsvgCalls& rsvg();

} // namespace rubato::plot
