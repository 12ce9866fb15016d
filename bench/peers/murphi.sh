#!/bin/bash
# murphi.sh N F: the model for rumur; see promela.sh for what the numbers mean.
N=$1; F=$2
cat <<X
type id: 0..$((N - 1));
var phase: 0..$((7 + 3 * N));
    u: array [id] of 0..5;
    ready: array [id] of 0..1;
    rv: array [id] of 0..3;
    busy: boolean;
    left: 0..$((2 * N));
function executing(): boolean; begin return phase = 5 & left > 0; end;
procedure failed(code: 0..$((7 + 3 * N))); begin
  phase := code; left := 0; busy := false;
  for j: id do u[j] := 0; rv[j] := 0; end;
end;
startstate begin
  phase := 0; busy := false; left := $((2 * N));
  for i: id do u[i] := 0; ready[i] := 0; rv[i] := 0; end;
end;
rule "script" phase < 5 ==> phase := phase + 1; end;
rule "end" phase = 5 & left = 0 ==> phase := 7; end;
ruleset i: id do
  rule "start survey" executing() & u[i] = 0 ==> u[i] := 1; end;
  rule "survey done" executing() & u[i] = 1 ==> u[i] := 2; end;
  rule "post" executing() & u[i] = 2 ==> u[i] := 3; ready[i] := ready[i] + 1; end;
  rule "start sk" executing() & u[i] = 3 ==> u[i] := 4; end;
  rule "sk done" executing() & u[i] = 4 ==> u[i] := 5; left := left - 1; end;
  rule "consume" executing() & !busy & rv[i] = 0 & ready[i] > 0 ==> ready[i] := ready[i] - 1; rv[i] := 1; busy := true; end;
  rule "start rv" executing() & rv[i] = 1 ==> rv[i] := 2; end;
  rule "rv done" executing() & rv[i] = 2 ==> rv[i] := 3; busy := false; left := left - 1; end;
X
[ "$F" = 1 ] && cat <<X
  rule "survey fails" executing() & u[i] = 1 ==> failed(8 + 3 * i); end;
  rule "sk fails" executing() & u[i] = 4 ==> failed(9 + 3 * i); end;
  rule "rv fails" executing() & rv[i] = 2 ==> failed(10 + 3 * i); end;
X
echo "end;"
echo "invariant \"one tuple each\" forall i: id do ready[i] <= 1 end;"
