#include "damaged_jpeg.h"

#include <csetjmp>
#include <cstdio>  // for jpeglib.h

#include <jpeglib.h>
// Behind it.
#include <jerror.h>

namespace sunlit::image {
namespace {

struct Listener {
  jpeg_error_mgr manager;  ///< first: libjpeg knows this alone
  std::jmp_buf end;
  bool is_damaged = false;
};

Listener& listenerOf(j_common_ptr coder) {
  return *reinterpret_cast<Listener*>(coder->err);
}

/// Nothing follows an error; libjpeg is C, which no exception goes through.
void onError(j_common_ptr coder) {
  std::longjmp(listenerOf(coder).end, 1);
}

/// Of levels below 0, which are warnings. Those of headers and of the end of data are the business of others.
void onMessage(j_common_ptr coder, int level) {
  const int code = coder->err->msg_code;
  if (level < 0 && (code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE || code == JWRN_ARITH_BAD_CODE ||
                    code == JWRN_MUST_RESYNC || code == JWRN_BOGUS_PROGRESSION))
    listenerOf(coder).is_damaged = true;
}

}  // namespace

// Coefficients are read and nothing is made of them, in half of the time of decoding.
bool damagedJpeg(const std::uint8_t* bytes, std::size_t size) {
  jpeg_decompress_struct coder = {};
  Listener listener = {};
  coder.err = jpeg_std_error(&listener.manager);
  listener.manager.error_exit = onError;
  listener.manager.emit_message = onMessage;
  listener.manager.output_message = [](j_common_ptr) {};
  if (setjmp(listener.end) == 0) {
    jpeg_create_decompress(&coder);
    jpeg_mem_src(&coder, bytes, static_cast<unsigned long>(size));
    jpeg_read_header(&coder, TRUE);
    jpeg_read_coefficients(&coder);
  }  // else whoever decodes it says better what is wrong
  jpeg_destroy_decompress(&coder);
  return listener.is_damaged;
}

}  // namespace sunlit::image
