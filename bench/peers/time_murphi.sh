#!/bin/bash
# time_murphi.sh N G E L [symmetric]: the same for rumur; see time_promela.sh. Symmetric: vehicles are a scalarset.
N=$1; G=$2; E=$3; L=$4
id="0..$((N - 1))"
[ "${5:-}" = symmetric ] && id="scalarset($N)"
cat <<X
type id: $id;
var now: 0..$((G * (17 + 3 * N)));
    st: array [id] of 0..2;
    age: array [id] of 0..$((10 * G));
    rv: array [id] of 0..3;
    visit: 0..$((2 * G));
    left: 0..$((2 * N));
    busy: boolean;
    over: boolean;
function urgent(): boolean; begin return !busy & exists i: id do rv[i] = 1 end; end;
function due(): boolean; begin
  return (busy & visit = $((2 * G)))
    | exists i: id do (st[i] = 0 & age[i] = $((7 * G))) | (st[i] = 1 & age[i] = $((10 * G))) end;
end;
startstate begin
  now := 0; visit := 0; left := $((2 * N)); busy := false; over := false;
  for i: id do st[i] := 0; age[i] := 0; rv[i] := 0; end;
end;
rule "tick" left > 0 & !urgent() & !due() ==>
  now := now + 1;
  if busy then visit := visit + 1; end;
  for i: id do if st[i] < 2 then age[i] := age[i] + 1; end; end;
end;
rule "over" left = 0 & !over ==> over := true; end;
ruleset i: id do
  rule "surveyed" st[i] = 0 & age[i] >= $((4 * G)) & !urgent() ==> st[i] := 1; age[i] := 0; rv[i] := 1; end;
  rule "stayed" st[i] = 1 & age[i] = $((10 * G)) & !urgent() ==> st[i] := 2; age[i] := 0; left := left - 1; end;
  rule "visits" !busy & rv[i] = 1 ==> rv[i] := 2; busy := true; end;
  rule "visited" rv[i] = 2 & visit >= $G ==> rv[i] := 3; busy := false; visit := 0; left := left - 1; end;
end;
invariant "over in time" over -> (now >= $E & now <= $L);
X
