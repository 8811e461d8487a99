// What every use of HDF5 needs: its errors as text, its silence, and identifiers that are given back.
#pragma once

#include <cerrno>
#include <string>
#include <type_traits>
#include <utility>

#include <hdf5.h>

namespace stillpoint::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t>);

// The innermost entry of the library's error stack says most: "…, errno = 28, error message = 'No space left on
// device'".
inline std::string error_text() {
  std::string text = "HDF5 gives no reason";
  const auto keep_first = [](unsigned number, const H5E_error2_t* entry, void* kept) -> herr_t {
    if (number == 0 && entry->desc) *static_cast<std::string*>(kept) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  return text;
}

// While one lives, the library prints nothing of its own, and an errno is one of this time.
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

// An identifier that is given back at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*give_back)(hid_t)) : id_(id), give_back_(give_back) {}
  ~Handle() {
    if (id_ >= 0) give_back_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  // Gives it back now: that a last chunk cannot be written shows only here.
  [[nodiscard]] herr_t close() { return give_back_(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_;
  herr_t (*give_back_)(hid_t);
};

}  // namespace stillpoint::hdf5
