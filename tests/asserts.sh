#!/usr/bin/env bash
# Fails when the condition of an LW_ASSERT may have side effects: when it assigns, counts, or calls a function that is not listed
# here as one that only looks.
#   asserts.sh SOURCE_FOLDER
set -euo pipefail
looks='all_of any_of is_sorted static_cast size_t size empty count has_value ok error message find begin end front back
  is_finite refers check_image_size irradiance received vertices positions faces indices known ready accepts added'
cd "$1"
find lightwell fuzz bench tests \( -name '*.h' -o -name '*.cpp' \) -not -path lightwell/base/assert.h -print0 |
  LOOKS=$looks xargs -0 perl -0777 -e '
    my %looks = map { $_ => 1 } split " ", $ENV{LOOKS};
    my ($asserts, $wrong) = (0, 0);
    for my $file (@ARGV) {
      open(my $in, "<", $file) or die "$file: $!";
      my $text = <$in>;
      while ($text =~ /\bLW_ASSERT(\((?:[^()]++|(?1))*\))/g) {
        my $condition = $1;
        my @doubts = grep { !$looks{$_} } $condition =~ /(\w+)\s*(?:<[^<>()]*>)?\(/g;
        push @doubts, "an assignment" if $condition =~ /(?<![=!<>])=(?!=)|<<=|>>=/;
        push @doubts, "a step" if $condition =~ /\+\+|--/;
        $asserts++;
        $wrong += print "$file: LW_ASSERT$condition: may have a side effect: @doubts\n" if @doubts;
      }
    }
    die "no LW_ASSERT found\n" if $asserts == 0;
    exit($wrong > 0);'
