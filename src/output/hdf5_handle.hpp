// Helpers for every use of HDF5: its errors as text, its silence, and identifiers that are released automatically.
#pragma once

#include <cerrno>
#include <string>
#include <type_traits>
#include <utility>

#include <hdf5.h>

namespace stillpoint::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t>);

// The innermost entry of the library's error stack is the most specific: "…, errno = 28, error message = 'No space left
// on device'".
inline std::string error_text() {
  std::string text = "HDF5 gives no reason";
  const auto keep_first = [](unsigned number, const H5E_error2_t* entry, void* kept) -> herr_t {
    if (number == 0 && entry->desc) *static_cast<std::string*>(kept) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  return text;
}

// While an object exists, the library prints nothing of its own; errno is 0 at its beginning.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    errno = 0;
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// An identifier that is released at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*give_back)(hid_t)) : id_(id), give_back_(give_back) {}
  ~Handle() {
    if (id_ >= 0) give_back_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  // Releases it now: a failure to write the last chunk shows only here.
  [[nodiscard]] herr_t close() { return give_back_(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_;
  herr_t (*give_back_)(hid_t);
};

}  // namespace stillpoint::hdf5
