#include "results/texts.hpp"

#include <cstring>

namespace bristle::results {
namespace {

h5::Handle text_type() {
  h5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "creating a string type");
  h5::check(H5Tset_size(type, H5T_VARIABLE), "sizing a string type");
  h5::check(H5Tset_cset(type, H5T_CSET_UTF8), "choosing UTF-8");
  return type;
}

}  // namespace

h5::Handle create_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  const h5::Handle type = text_type();
  h5::Handle dataset = h5::create_dataset(parent, name, type, {texts.size()});
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  h5::write_part(dataset, type, {0}, {texts.size()}, pointers.data());
  return dataset;
}

bool is_text(hid_t dataset) {
  const h5::Handle type(H5Dget_type(dataset), H5Tclose, "reading a dataset's type");
  return H5Tget_class(type) == H5T_STRING;
}

void add_texts(Digest& digest, hid_t dataset) {
  const h5::Handle type = text_type();
  const h5::Handle space(H5Dget_space(dataset), H5Sclose, "reading a dataset's shape");
  const h5::Shape shape = h5::shape_of(dataset);
  std::vector<char*> texts(std::size_t(H5Sget_simple_extent_npoints(space)), nullptr);
  if (texts.empty()) return;
  h5::read_part(dataset, type, h5::Shape(shape.size(), 0), shape, texts.data());
  for (const char* text : texts) digest.add(text ? text : "", (text ? std::strlen(text) : 0) + 1);
  h5::check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data()), "freeing texts");
}

}  // namespace bristle::results
