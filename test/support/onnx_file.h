/// A network file in the ONNX format (onnx/onnx.proto3 of ONNX 1.12, written by hand: protocol buffers' wire
/// format), as small as a test needs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sunlit {

/// One message of protocol buffers.
class ProtoMessage {
 public:
  ProtoMessage& number(int field, std::uint64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3);
    varint(value);
    return *this;
  }
  ProtoMessage& text(int field, const std::string& bytes) {
    varint(static_cast<std::uint64_t>(field) << 3 | 2);
    varint(bytes.size());
    bytes_ += bytes;
    return *this;
  }
  ProtoMessage& message(int field, const ProtoMessage& part) { return text(field, part.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
    bytes_ += static_cast<char>(value);
  }
  std::string bytes_;
};

/// A convolution; unless told otherwise of the picture, over squares of 8 x 8 px that stand side by side.
struct Convolution {
  std::string output;          ///< its name
  std::vector<float> weights;  ///< for each output channel, input channel and row of the square
  std::vector<float> biases;   ///< one an output channel
  std::string input = "image";
  std::uint64_t input_channels = 1, side = 8, stride = 8, padding = 0;
  bool is_output = true;  ///< of the network
};

namespace onnx_parts {

inline ProtoMessage tensor(const std::string& name, const std::vector<std::uint64_t>& shape,
                           const std::vector<float>& values) {
  ProtoMessage made;
  for (const std::uint64_t side : shape) made.number(1, side);
  const std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return made.number(2, 1).text(8, name).text(9, bytes);
}

inline ProtoMessage list(const std::string& name, const std::vector<std::uint64_t>& values) {
  ProtoMessage made;
  made.text(1, name);
  for (const std::uint64_t value : values) made.number(8, value);
  return made.number(20, 7);
}

/// An input or output: of any height and width, or of one.
inline ProtoMessage picture(const std::string& name, std::uint64_t channels) {
  ProtoMessage shape;
  shape.message(1, ProtoMessage().number(1, 1)).message(1, ProtoMessage().number(1, channels));
  shape.message(1, ProtoMessage().text(2, "height")).message(1, ProtoMessage().text(2, "width"));
  return ProtoMessage().text(1, name).message(
      2, ProtoMessage().message(1, ProtoMessage().number(1, 1).message(2, shape)));
}

}  // namespace onnx_parts

/// The network of these convolutions, of which later ones may have earlier ones for their input.
inline std::string onnxFile(const std::vector<Convolution>& convolutions) {
  ProtoMessage graph;
  graph.text(2, "graph");
  for (const Convolution& one : convolutions) {
    const std::uint64_t channels = one.biases.size();
    ProtoMessage node;
    node.text(1, one.input).text(1, one.output + "_weights").text(1, one.output + "_biases");
    node.text(2, one.output).text(3, one.output).text(4, "Conv");
    node.message(5, onnx_parts::list("kernel_shape", {one.side, one.side}));
    node.message(5, onnx_parts::list("strides", {one.stride, one.stride}));
    const std::uint64_t p = one.padding;
    node.message(5, onnx_parts::list("pads", {p, p, p, p}));
    graph.message(1, node);
    graph.message(5, onnx_parts::tensor(one.output + "_weights",
                                        {channels, one.input_channels, one.side, one.side}, one.weights));
    graph.message(5, onnx_parts::tensor(one.output + "_biases", {channels}, one.biases));
    if (one.is_output) graph.message(12, onnx_parts::picture(one.output, channels));
  }
  graph.message(11, onnx_parts::picture("image", 1));
  return ProtoMessage().number(1, 7).message(7, graph).message(8, ProtoMessage().number(2, 11)).bytes();
}

/// Points: that channel of a cell is `gain` of whose pixel it is; that of no point 0. Descriptors: the sum of
/// grey (0 to 1) over the upper and over the lower half of a cell, and `constant`.
inline std::string brightPixelNetwork(float gain, float constant) {
  Convolution points{"semi", std::vector<float>(65 * 64, 0.0F), std::vector<float>(65, 0.0F)};
  for (int i = 0; i < 64; ++i) points.weights[i * 64 + i] = gain;
  Convolution descriptors{"desc", std::vector<float>(3 * 64, 0.0F), {0.0F, 0.0F, constant}};
  for (int i = 0; i < 32; ++i) descriptors.weights[i] = descriptors.weights[64 + 32 + i] = 1.0F;
  return onnxFile({points, descriptors});
}

}  // namespace sunlit
