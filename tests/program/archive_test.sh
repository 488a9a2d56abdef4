#!/bin/bash
# The commands archive and verify: the result of a quick experiment in a repository of its own is archived, verified,
# computed again and damaged. usage: archive_test.sh BRISTLE SOURCE
set -u
bristle=$1 source=$2
. "$(dirname "$0")/shell.sh"

cd "$folder" && "$source/tests/program/small_repository.sh" "$bristle" "$source" || failed "no repository"
expect 2 "there are no results" "$bristle" archive --allow-dirty
expect 0 "4 ok" "$bristle" run experiments/quick.json
expect 2 "figures/quick.pdf: no such file" "$bristle" archive --allow-dirty
touch figures/quick.{pdf,png}
expect 2 "figures/quick.pdf: was not made from results/quick.h5 as it is now, whose payload digest it lacks; \`make quick\` draws it again" \
  "$bristle" archive --allow-dirty
echo "payload_sha256 $(digest results/quick.h5)" | tee figures/quick.pdf >figures/quick.png
expect 2 "assumptions.json: no such file; \`make assumptions\` computes it" "$bristle" archive --allow-dirty
expect 0 "1 checks under 1 alternatives" "$bristle" assumptions --tier full -q
expect 0 "results/assumptions.json: up to date" "$bristle" assumptions --tier full -q
for change in 's/"under":\[\["[a-z]*"/"under":[["changed"/' 's/"inputs_sha256": "[^"]*"/"inputs_sha256": 7/'; do
  sed -i "$change" results/assumptions.json
  expect 0 "1 checks under 1 alternatives" "$bristle" assumptions --tier full -q
done
# The program was built from another repository.
expect 2 "this program, of commit" "$bristle" archive
expect 0 "verified" "$bristle" archive --allow-dirty
archive=$(ls dist/*.tar)
expect 0 "a draft, not to be cited: " "$bristle" verify "$archive"
expect 0 "a draft" "$bristle" archive --allow-dirty -o again.tar
cmp "$archive" again.tar || failed "line $LINENO"

# Standard tools can check the archive.
mkdir unpacked && tar xf "$archive" -C unpacked || failed "line $LINENO"
(cd unpacked/* && sha512sum --quiet -c manifest-sha512.txt tagmanifest-sha512.txt) || failed "line $LINENO"
(cd unpacked/*/data && [ "$(git get-tar-commit-id <source/*.tar)" = "$(git -C "$folder" rev-parse HEAD)" ]) || failed "line $LINENO"
cmp unpacked/*/data/results/quick.h5 results/quick.h5 || failed "line $LINENO"

# A limit on the size of files: a message, an exit code, and no temporary file.
limited() { (ulimit -f 16; "$@"); }
expect 3 "big.tar: cannot be written completely: File too large" limited "$bristle" archive --allow-dirty -o big.tar
[ -z "$(ls big.tar* 2>/dev/null)" ] || failed "a part of an archive was left"

# What is left of an archive that was killed is replaced; anything else is not.
head -c 5000 "$archive" >killed.tar.partial
expect 0 "verified" "$bristle" archive --allow-dirty -o killed.tar
cp LICENSE mine.tar.partial
expect 2 "mine.tar.partial: is not the remainder of an archive" "$bristle" archive --allow-dirty -o mine.tar
cmp LICENSE mine.tar.partial || failed "line $LINENO"

# Points computed again.
expect 0 "3 of 3 points computed again are the same, bit for bit (seed 1)" "$bristle" verify "$archive" --rerun 3
expect 0 "k_r = 20, friction = coulomb: the same, bit for bit" "$bristle" verify "$archive" --rerun 9 --seed 5
expect 2 "--rerun" "$bristle" verify "$archive" --rerun x

# No copies of the results remain if the program is killed: it makes no temporary files.
expect 0 "same, bit for bit" env TMPDIR=/nowhere "$bristle" verify "$archive" --rerun 1

# Damage.
expect 2 "no such file" "$bristle" verify nowhere.tar
expect 2 "ARCHIVE is required" "$bristle" verify
expect 1 "no tar archive" "$bristle" verify CITATION.cff
expect 1 "a result, not an archive; \`bristle info results/quick.h5\` checks its digest" "$bristle" verify results/quick.h5
gzip -k again.tar
expect 1 "compressed (gzip)" "$bristle" verify again.tar.gz
head -c 30000 "$archive" >cut.tar
expect 1 "NOT as it was archived" "$bristle" verify cut.tar
at=$(grep -obUaF 'Permission is hereby granted' "$archive" | head -n 1 | cut -d: -f1)
printf 'p' | dd of="again.tar" bs=1 seek="$at" conv=notrunc status=none
expect 1 "FAILED: data/LICENSE: its SHA-512 is" "$bristle" verify again.tar
# The same files packed by another program: not the archive that was published.
tar cf packed.tar -C unpacked --sort=name "$(ls unpacked)"
expect 1 "NOT as it was archived" "$bristle" verify packed.tar
exit $((failures > 0))
