<!DOCTYPE PickedPoints>
<PickedPoints>
<point x="0" y="1" z="0" name="a" active="1"/>
</PickedPoints>
