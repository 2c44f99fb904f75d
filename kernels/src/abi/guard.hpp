// The one wrapper of every interface function: runs the body, turns exceptions into a status and a
// message for this thread. Nothing leaves it but the status.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "core/error.hpp"

namespace cleave::abi {

// Message of the calling thread; never throws.
void set_last_message(const char* function, const char* message) noexcept;

template <class Body>
std::int32_t guarded(const char* function, Body&& body) noexcept {
  try {
    body();
    return CLEAVE_OK;
  } catch (const Error& e) {
    set_last_message(function, e.what());
    return e.status;
  } catch (const std::bad_alloc&) {
    set_last_message(function, "not enough memory");
    return CLEAVE_OUT_OF_MEMORY;
  } catch (const std::length_error&) {  // beyond what any array can hold
    set_last_message(function, "not enough memory");
    return CLEAVE_OUT_OF_MEMORY;
  } catch (const std::exception& e) {
    set_last_message(function, e.what());
    return CLEAVE_INTERNAL;
  } catch (...) {
    set_last_message(function, "unknown exception");
    return CLEAVE_INTERNAL;
  }
}

template <class T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) {
    throw Error(CLEAVE_NULL_ARGUMENT, text("argument '", name, "' is NULL; pass a valid pointer"));
  }
  return *pointer;
}

inline void check_abi(std::int32_t abi) {
  if (abi != CLEAVE_ABI_VERSION) {
    throw Error(CLEAVE_ABI_MISMATCH,
                text("the caller was compiled for interface ", abi, ", this library has ",
                     CLEAVE_ABI_VERSION, "; compile it with the installed cleave.h"));
  }
}

inline void check_range(std::int64_t first, std::int64_t last, std::int64_t count) {
  if (first < 0 || last < first || last > count) {
    throw Error(CLEAVE_BAD_RANGE, text("range ", first, " <= i < ", last,
                                       " does not lie inside the array of ", count, " entries"));
  }
}

// Interface structs begin with their size: a caller compiled with a smaller, older one is served.
template <class T>
void fill_sized(T* target, T value, const char* name) {
  T& out = required(target, name);
  const std::int64_t size = out.size;
  if (size < static_cast<std::int64_t>(sizeof(std::int64_t)) ||
      size > static_cast<std::int64_t>(sizeof(T))) {
    throw Error(CLEAVE_ABI_MISMATCH,
                text("struct '", name, "' has size ", size, "; set its member `size` to sizeof (",
                     sizeof(T), " in this library)"));
  }
  value.size = size;
  __builtin_memcpy(target, &value, static_cast<std::size_t>(size));
}

}  // namespace cleave::abi
