// SPDX-License-Identifier: LGPL-3.0-or-later
/// Shared libraries that are loaded when a program first uses them. A library that the program is linked with
/// costs time at every start, with all libraries that it depends on.
#pragma once

namespace rubato {

/// A shared library, and the words of the message when it is missing.
struct LibraryName {
  const char* soname;         ///< the name that the loader searches for: "libmedC.so.11"; or a path
  const char* package;        ///< the Debian package that has it; empty on other systems
  const char* users;          ///< what needs it, in the plural: "MED files"
  const char* otherwise = ""; ///< what can be done instead of installing it: " or convert the mesh to MED"
};

/// The address of a function or variable in a library. Converts to a pointer of the type that the header of
/// the library declares; the caller must name the right type.
class LibrarySymbol {
public:
  explicit LibrarySymbol(void* address) : address_(address) {}
  template <class T> operator T*() const { return reinterpret_cast<T*>(address_); }

private:
  void* address_;
};

/// A loaded library. It stays loaded until the process ends, because libraries that it depends on register
/// functions which run at exit.
class DynamicLibrary {
public:
  /// Loads the library with its symbols local, so that they cannot replace equal names of other libraries.
  /// Throws InputError, with the reason of the loader and the package to install, when the library cannot be
  /// loaded.
  explicit DynamicLibrary(const LibraryName& name);

  /// Throws InputError when neither the library nor one that it depends on defines the symbol.
  LibrarySymbol symbol(const char* name) const;

private:
  LibraryName name_;
  void* handle_;
};

} // namespace rubato
