#include "checkpoint_keeper.hpp"

#include <algorithm>
#include <vector>

#include "output_file.hpp"
#include "result_folder.hpp"

namespace fixdem::program {

namespace files = std::filesystem;

void CheckpointKeeper::write(Checkpoint& checkpoint) {
  const files::path path = checkpoint_path(out_, checkpoint.step);
  write_file(path, encode_checkpoint(checkpoint), Durability::durable);
  for (const files::path& other : checkpoints_in(out_))
    if (other != path && other.filename() != last_.filename()) remove_file(other);
  if (path.filename() != last_.filename()) last_ = path;
}

void CheckpointKeeper::remove_all_but(const files::path& kept) const {
  const std::vector<files::path> all = checkpoints_in(out_);
  for (auto path = all.rbegin(); path != all.rend(); ++path)
    if (path->filename() != kept.filename()) remove_file(*path);
}

}  // namespace fixdem::program
