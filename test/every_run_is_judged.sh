# Every cram test that runs programs has their journals judged: by check-journals, or by itself.

cd "$(dirname "$0")"
status=0
for test in $(find . -name '*.t' -type f); do
  runs=$(grep -E '^  [$>] .*dolphin exec' "$test" | grep -v -e '--help' -e '--follow' -e 'dolphin exec/')
  if [ -n "$runs" ] && ! grep -q -e '^  \$ check-journals$' -e 'dolphin trace check' "$test"; then
    echo "test/${test#./}: programs run here, and nothing judges their journals:"
    echo "end the test with '  \$ check-journals'"
    status=1
  fi
done
exit $status
