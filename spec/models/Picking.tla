------------------------------- MODULE Picking -------------------------------
(* PICK, PICK-BIND, PICK-ERR: any two of three, then all that are left, then none. *)
EXTENDS Model

Two == Pick(<< Setting("type", String("UUV")), Setting("count", Integer(2)) >>)
Rest == Pick(<< Setting("count", Wildcard) >>)

Body == Block(<< Assign(1, Two), Assign(2, Rest), Assign(1, PickId("u1")) >>)

Closures == << >>

Claim ==
  /\ Cardinality(Range(B)) = Len(B)
  /\ By_("PICK-BIND", LAMBDA t : Len(t.S.B) \in { 2, 4 })
  /\ By_("PICK-ERR", LAMBDA t : Len(B) = 4 /\ Fails_(t))
==============================================================================
