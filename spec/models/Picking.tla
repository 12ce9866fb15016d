------------------------------- MODULE Picking -------------------------------
(* PICK, PICK-BIND, PICK-ELSE, PICK-ERR: any two of three, then all that are left, then none, twice. *)
EXTENDS Model

Two == Pick(<< Setting("type", String("UUV")), Setting("count", Integer(2)) >>)
IfAny == Apply([ op |-> "build", builder |-> "pick if any" ], << Const(Settings(<< >>)) >>)
Rest == Pick(<< Setting("count", Wildcard) >>)

Body == Block(<< Assign(1, Two), Assign(2, Rest), Assign(2, IfAny), Assign(1, PickId("u1")) >>)

Closures == << >>

Claim ==
  /\ Cardinality(Range(B)) = Len(B)
  /\ By_("PICK-BIND", LAMBDA t : Len(t.S.B) \in { 2, 4 })
  /\ By_("PICK-ELSE", LAMBDA t : t.S.B = B)
  /\ By_("PICK-ERR", LAMBDA t : Len(B) = 4 /\ Fails_(t))
==============================================================================
